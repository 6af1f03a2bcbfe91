// The `pomona` command: parses, runs a verb, and turns whatever goes wrong into one line and an exit status.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>
#include <new>
#include <opencv2/core/utils/logger.hpp>
#include <string>

#include "apps/verbs.h"

namespace {

constexpr int kBadInput = 1;
constexpr int kBadUsage = 2;
const std::string kVerbs =
    "compute, measure, eval, compare, range, plugins, calibrate, rig, rectify, check, render or info (see "
    "pomona --help)";

int fail(std::string message, int status) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cout.flush();
  std::cerr << "pomona: error: " << message << '\n';
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is then an error of write(), like a full disk
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);

  CLI::App app("Dense disparity maps from rectified stereo pairs.", "pomona");
  app.set_version_flag("--version", "pomona " POMONA_VERSION);
  pomona::addCompute(app);
  pomona::addEval(app);
  pomona::addCompare(app);
  pomona::addMeasure(app);
  pomona::addRange(app);
  pomona::addPlugins(app);
  pomona::addCalibrate(app);
  pomona::addRig(app);
  pomona::addRectify(app);
  pomona::addCheck(app);
  pomona::addRender(app);
  pomona::addInfo(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) return fail("what to do? " + kVerbs, kBadUsage);
    if (!std::cout.flush()) return fail("standard output: cannot be written", kBadInput);
  } catch (const CLI::ConversionError& e) {
    return fail(std::string(e.what()) + "; allowed: a number (of 32 bits, where whole)", kBadInput);
  } catch (const CLI::ValidationError& e) {
    return fail(e.what(), kBadInput);
  } catch (const CLI::ExtrasError& e) {
    const bool is_verb = app.get_subcommands().empty() && argv[1][0] != '-';
    return fail(is_verb ? std::string("there is no verb '") + argv[1] + "'; allowed: " + kVerbs
                        : std::string(e.what()) + " (see pomona --help)",
                kBadUsage);
  } catch (const CLI::RuntimeError& e) {  // a verb's verdict, which it has printed
    return std::cout.flush() ? e.get_exit_code() : fail("standard output: cannot be written", kBadInput);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help and --version
    return fail(std::string(e.what()) + " (see pomona --help)", kBadUsage);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", kBadInput);
  } catch (const std::exception& e) {
    return fail(e.what(), kBadInput);
  }
  return 0;
}
