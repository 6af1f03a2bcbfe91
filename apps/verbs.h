// The verbs of the command. Each adds its subcommand to `app`; parsing the command line then runs it. Verbs
// report bad input by throwing std::invalid_argument or std::runtime_error.
#pragma once

namespace CLI {
class App;
}

namespace pomona {

/// Exit status of a verb that did its work and has no good news: `check` of a pair that cannot be matched,
/// `measure` of which nothing could be measured. Thrown as CLI::RuntimeError.
inline constexpr int kNegativeVerdict = 3;

void addCalibrate(CLI::App& app);
void addCheck(CLI::App& app);
void addCompare(CLI::App& app);
void addCompute(CLI::App& app);
void addEval(CLI::App& app);
void addInfo(CLI::App& app);
void addMeasure(CLI::App& app);
void addPlugins(CLI::App& app);
void addRange(CLI::App& app);
void addRectify(CLI::App& app);
void addRender(CLI::App& app);
void addRig(CLI::App& app);

}  // namespace pomona
