#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "plugins/host/text.h"
#include "pomona/plugin_settings.h"

namespace pomona {
namespace {

constexpr std::string_view kVariant = "variant", kDefault = "default";

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// NaN if `text` is not a number from beginning to end.
double numberIn(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool complete = error == std::errc{} && end == text.data() + text.size();
  return complete ? value : std::numeric_limits<double>::quiet_NaN();
}

bool isAllowed(const PluginParameter& parameter, std::string_view text) {
  const double number = numberIn(text);
  const bool in_range = parameter.min <= number && number <= parameter.max;  // not for NaN
  switch (parameter.kind) {
    case ParameterKind::kInteger:
      return in_range && number == std::floor(number);
    case ParameterKind::kReal:
      return in_range;
    case ParameterKind::kSwitch:
      return text == "on" || text == "off";
    case ParameterKind::kChoice:
      return std::find(parameter.choices.begin(), parameter.choices.end(), text) != parameter.choices.end();
    case ParameterKind::kText:
      return true;
  }
  return false;
}

}  // namespace

PluginParameter integerParameter(std::string name, std::string description, int value, int min, int max) {
  return {std::move(name),
          std::move(description),
          ParameterKind::kInteger,
          std::to_string(value),
          static_cast<double>(min),
          static_cast<double>(max),
          {}};
}

PluginParameter realParameter(std::string name, std::string description, double value, double min,
                              double max) {
  return {std::move(name), std::move(description), ParameterKind::kReal, shortNumber(value), min, max, {}};
}

PluginParameter switchParameter(std::string name, std::string description, bool value) {
  return {std::move(name), std::move(description), ParameterKind::kSwitch, value ? "on" : "off", 0, 0, {}};
}

PluginParameter choiceParameter(std::string name, std::string description, std::vector<std::string> choices) {
  std::string first = choices.empty() ? "" : choices.front();
  return {std::move(name),   std::move(description), ParameterKind::kChoice, std::move(first), 0, 0,
          std::move(choices)};
}

PluginParameter textParameter(std::string name, std::string description, std::string value) {
  return {std::move(name), std::move(description), ParameterKind::kText, std::move(value), 0, 0, {}};
}

std::string allowedValues(const PluginParameter& parameter) {
  switch (parameter.kind) {
    case ParameterKind::kInteger:
      return "whole numbers, " + std::to_string(std::llround(parameter.min)) + " to " +
             std::to_string(std::llround(parameter.max));
    case ParameterKind::kReal:
      return shortNumber(parameter.min) + " to " + shortNumber(parameter.max);
    case ParameterKind::kSwitch:
      return "on, off";
    case ParameterKind::kChoice:
      return listed(parameter.choices);
    case ParameterKind::kText:
      return "any text";
  }
  return "";
}

PluginSettings::PluginSettings(std::string plugin, std::vector<PluginParameter> parameters,
                               std::vector<ParameterSet> sets)
    : plugin_(std::move(plugin)), parameters_(std::move(parameters)), sets_(std::move(sets)) {
  for (const PluginParameter& parameter : parameters_) {
    if (!isPlainName(parameter.name, '_') || parameter.name == kVariant)
      throw std::invalid_argument(plugin_ + ": a parameter is called '" + parameter.name +
                                  "'; allowed: lower-case letters, digits and underscores, and not variant");
    if (!values_.emplace(parameter.name, parsed(parameter, parameter.default_value)).second)
      throw std::invalid_argument(plugin_ + ": two parameters are called '" + parameter.name + "'");
  }
  for (const ParameterSet& set : sets_) {
    if (!isPlainName(set.name, '-') || set.name == kDefault)
      throw std::invalid_argument(plugin_ + ": a parameter set is called '" + set.name +
                                  "'; allowed: lower-case letters, digits and hyphens, and not default");
    for (const auto& [name, value] : set.values) parsed(declared(name), value);
  }
}

void PluginSettings::set(std::string_view name, std::string_view value) {
  if (name == kVariant) return setVariant(value);
  const PluginParameter& parameter = declared(name);
  values_.find(name)->second = parsed(parameter, value);
}

void PluginSettings::assign(std::span<const std::string> assignments) {
  const auto parts = [this](std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string_view::npos)
      throw std::invalid_argument(plugin_ + ": setting is '" + std::string(assignment) +
                                  "'; allowed: name=value");
    return std::pair{assignment.substr(0, equals), assignment.substr(equals + 1)};
  };
  for (const bool variant : {true, false})
    for (const std::string& assignment : assignments)
      if (const auto [name, value] = parts(assignment); (name == kVariant) == variant) set(name, value);
}

int PluginSettings::integer(std::string_view name) const {
  return static_cast<int>(value(name, ParameterKind::kInteger).number);
}

double PluginSettings::real(std::string_view name) const {
  return value(name, ParameterKind::kReal).number;
}

bool PluginSettings::isOn(std::string_view name) const {
  return value(name, ParameterKind::kSwitch).text == "on";
}

const std::string& PluginSettings::text(std::string_view name) const {
  const bool chosen = declared(name).kind == ParameterKind::kChoice;
  return value(name, chosen ? ParameterKind::kChoice : ParameterKind::kText).text;
}

std::vector<std::pair<std::string, std::string>> PluginSettings::values() const {
  std::vector<std::pair<std::string, std::string>> values;
  for (const PluginParameter& parameter : parameters_)
    values.emplace_back(parameter.name, values_.find(parameter.name)->second.text);
  return values;
}

const PluginParameter& PluginSettings::declared(std::string_view name) const {
  std::vector<std::string> names;
  for (const PluginParameter& parameter : parameters_) {
    if (parameter.name == name) return parameter;
    names.push_back(parameter.name);
  }
  names.emplace_back(kVariant);
  throw std::invalid_argument(plugin_ + ": parameter is '" + std::string(name) +
                              "'; allowed: " + listed(names));
}

const PluginSettings::Value& PluginSettings::value(std::string_view name, ParameterKind kind) const {
  const auto wanted = [&](const PluginParameter& p) { return p.name == name && p.kind == kind; };
  if (std::none_of(parameters_.begin(), parameters_.end(), wanted))
    throw std::logic_error(plugin_ + ": asks for '" + std::string(name) +
                           "', which it does not declare, or as another kind");
  return values_.find(name)->second;
}

PluginSettings::Value PluginSettings::parsed(const PluginParameter& parameter, std::string_view text) const {
  if (!isAllowed(parameter, text))
    throw std::invalid_argument(plugin_ + ": " + parameter.name + " is '" + std::string(text) +
                                "'; allowed: " + allowedValues(parameter));
  return {numberIn(text), std::string(text)};
}

void PluginSettings::setVariant(std::string_view name) {
  const auto named = [&](const ParameterSet& set) { return set.name == name; };
  const auto set = std::find_if(sets_.begin(), sets_.end(), named);
  if (set == sets_.end() && name != kDefault) {
    std::vector<std::string> names{std::string(kDefault)};
    for (const ParameterSet& other : sets_) names.push_back(other.name);
    throw std::invalid_argument(plugin_ + ": variant is '" + std::string(name) +
                                "'; allowed: " + listed(names));
  }
  for (const PluginParameter& parameter : parameters_)
    values_.find(parameter.name)->second = parsed(parameter, parameter.default_value);
  if (set == sets_.end()) return;
  for (const auto& [key, value] : set->values) values_.find(key)->second = parsed(declared(key), value);
}

}  // namespace pomona
