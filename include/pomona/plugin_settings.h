// The parameters a plugin declares, and the values it is run with.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pomona {

enum class ParameterKind {
  kInteger,
  kReal,
  kSwitch,  ///< on or off
  kChoice,  ///< one of a few words
  kText,    ///< anything, e.g. the path of a file
};

/// One parameter. Made by the functions below.
struct PluginParameter {
  std::string name;  ///< lower-case letters, digits and underscores; with its unit: "max_row_offset_px"
  std::string description;  ///< a line, without full stop
  ParameterKind kind = ParameterKind::kText;
  std::string default_value;
  double min = 0, max = 0;           ///< allowed range, ends included: kInteger, kReal
  std::vector<std::string> choices;  ///< kChoice
};

PluginParameter integerParameter(std::string name, std::string description, int value, int min, int max);
PluginParameter realParameter(std::string name, std::string description, double value, double min,
                              double max);
PluginParameter switchParameter(std::string name, std::string description, bool value);
/// The first of `choices` is the default.
PluginParameter choiceParameter(std::string name, std::string description, std::vector<std::string> choices);
PluginParameter textParameter(std::string name, std::string description, std::string value = "");

/// For people: "0 to 1", "whole numbers, 0 to 100", "on, off", "fast, slow", "any text".
std::string allowedValues(const PluginParameter& parameter);

/// Values that belong together, e.g. those of a paper. "variant=NAME" sets them.
struct ParameterSet {
  std::string name;         ///< "faithful"; "default" is taken: no value changed
  std::string description;  ///< a line
  std::vector<std::pair<std::string, std::string>> values;  ///< name and value; all others at their defaults
};

/// The values for one run: the defaults, changed by set(). Everything in it is allowed, so plugins need not
/// check ranges.
class PluginSettings {
 public:
  /// `plugin` is the name that errors begin with. Throws std::invalid_argument if a declaration contradicts
  /// itself: two parameters of one name, a default out of range, a set that sets what cannot be set.
  PluginSettings(std::string plugin, std::vector<PluginParameter> parameters,
                 std::vector<ParameterSet> sets = {});

  /// Sets one value, given as text: numbers in C notation, on/off, a choice, or any text. The key `variant`
  /// puts all values to those of a parameter set (or `default`). Throws std::invalid_argument "region-sift:
  /// ratio is '3'; allowed: 0 to 1".
  void set(std::string_view name, std::string_view value);
  /// Sets values written "name=value": first the variant, if there is one, then all others in their order.
  void assign(std::span<const std::string> assignments);

  /// Values by name. A name that is not declared, or not of that kind, is the plugin's mistake:
  /// std::logic_error.
  int integer(std::string_view name) const;
  double real(std::string_view name) const;
  bool isOn(std::string_view name) const;
  const std::string& text(std::string_view name) const;  ///< kText and kChoice

  /// All names and values, in the order of their declaration.
  std::vector<std::pair<std::string, std::string>> values() const;

 private:
  struct Value {
    double number = 0;
    std::string text;
  };
  const PluginParameter& declared(std::string_view name) const;
  const Value& value(std::string_view name, ParameterKind kind) const;
  Value parsed(const PluginParameter& parameter, std::string_view text) const;
  void setVariant(std::string_view name);

  std::string plugin_;
  std::vector<PluginParameter> parameters_;
  std::vector<ParameterSet> sets_;
  std::map<std::string, Value, std::less<>> values_;
};

}  // namespace pomona
