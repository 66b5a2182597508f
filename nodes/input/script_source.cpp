// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/script_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "common/core/base/constants.hpp"
#include "common/core/base/suggest.hpp"

namespace rodeira::nodes {
namespace {

using dynamics::Controls;

std::vector<std::string> Split(std::string_view line) {
  std::vector<std::string> cells;
  for (;;) {
    const auto comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r')) cell.remove_suffix(1);
    cells.emplace_back(cell);
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

struct Column {
  std::string name;
  double low;
  double high;
  void (*set)(Controls&, double);
  bool whole = false;
};

constexpr double kTurns = 10.0 * base::kPi;  // more than any steering wheel turns

const std::vector<Column>& Columns() {
  static const std::vector<Column> kColumns = {
      {"time_s", 0.0, 1e7, [](Controls&, double) {}},
      {"steering_wheel_rad", -kTurns, kTurns, [](Controls& c, double x) { c.steering_wheel_rad = x; }},
      {"steering_wheel_deg", -1800.0, 1800.0,
       [](Controls& c, double x) { c.steering_wheel_rad = x * base::kPi / 180.0; }},
      {"throttle", 0.0, 1.0, [](Controls& c, double x) { c.throttle = x; }},
      {"brake", 0.0, 1.0, [](Controls& c, double x) { c.brake = x; }},
      {"clutch", 0.0, 1.0, [](Controls& c, double x) { c.clutch = x; }},
      {"handbrake", 0.0, 1.0, [](Controls& c, double x) { c.handbrake = x; }},
      {"gear", -1.0, 20.0, [](Controls& c, double x) { c.gear = static_cast<std::int32_t>(x); }, true},
      {"manual", 0.0, 1.0,
       [](Controls& c, double x) {
         c.gearbox = x != 0.0 ? dynamics::GearboxMode::kManual : dynamics::GearboxMode::kAutomatic;
       },
       true},
      {"starter", 0.0, 1.0, [](Controls& c, double x) { c.starter = x != 0.0; }, true},
  };
  return kColumns;
}

std::vector<std::string> ColumnNames() {
  std::vector<std::string> names;
  for (const Column& column : Columns()) names.push_back(column.name);
  return names;
}

base::Result<std::vector<const Column*>> ReadHead(const std::string& line, const std::string& where) {
  std::vector<const Column*> columns;
  for (const std::string& name : Split(line)) {
    const auto found =
        std::find_if(Columns().begin(), Columns().end(), [&](const Column& column) { return column.name == name; });
    if (found == Columns().end())
      return base::WrongInput("table.unknown_column",
                              fmt::format("unknown column '{}'{}", name, base::DidYouMean(name, ColumnNames())), where);
    if (std::find(columns.begin(), columns.end(), &*found) != columns.end())
      return base::WrongInput("table.duplicate_column", fmt::format("column '{}' appears twice", name), where);
    columns.push_back(&*found);
  }
  if (columns.front()->name != "time_s")
    return base::WrongInput("table.wrong_row",
                            fmt::format("the first column is '{}'; 'time_s' was expected", columns.front()->name),
                            where);
  return columns;
}

base::Result<double> ReadCell(const Column& column, const std::string& cell, const std::string& where) {
  double value = 0.0;
  const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool number = problem == std::errc{} && end == cell.data() + cell.size();
  if (!number || !(value >= column.low && value <= column.high) || (column.whole && value != std::floor(value))) {
    return base::WrongInput("table.wrong_row",
                            fmt::format("'{}' is '{}'; {} number from {} to {} was expected", column.name,
                                        cell.substr(0, 40), column.whole ? "a whole" : "a", column.low, column.high),
                            where);
  }
  return value;
}

}  // namespace

base::Result<Script> Script::Parse(std::string_view text, const std::filesystem::path& name) {
  Script script;
  std::vector<const Column*> columns;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const auto end = text.find('\n');
    const std::string line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::string where = fmt::format("{}:{}", name.string(), number);
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    if (columns.empty()) {
      auto head = ReadHead(line, where);
      if (!head) return head.error();
      columns = std::move(head).value();
      continue;
    }
    const auto cells = Split(line);
    if (cells.size() != columns.size())
      return base::WrongInput("table.wrong_row",
                              fmt::format("{} values were found, {} were expected", cells.size(), columns.size()),
                              where);
    Row row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = ReadCell(*columns[i], cells[i], where);
      if (!value) return value.error();
      if (i == 0) row.time_s = value.value();
      columns[i]->set(row.controls, value.value());
    }
    if (!script.rows_.empty() && row.time_s <= script.rows_.back().time_s) {
      return base::WrongInput(
          "table.wrong_row",
          fmt::format("time_s {} follows {}; ascending times were expected", row.time_s, script.rows_.back().time_s),
          where);
    }
    script.rows_.push_back(row);
  }
  if (script.rows_.empty())
    return base::WrongInput("table.wrong_row", "the script has no row; a head line and at least one row were expected",
                            name.string());
  return script;
}

Controls Script::At(double time_s) const {
  const auto after =
      std::upper_bound(rows_.begin(), rows_.end(), time_s, [](double t, const Row& row) { return t < row.time_s; });
  if (after == rows_.begin()) return rows_.front().controls;
  const Row& before = *(after - 1);
  Controls controls = before.controls;
  if (after == rows_.end()) return controls;
  const double part = (time_s - before.time_s) / (after->time_s - before.time_s);
  const auto between = [part](double a, double b) { return a + part * (b - a); };
  controls.steering_wheel_rad = between(before.controls.steering_wheel_rad, after->controls.steering_wheel_rad);
  controls.throttle = between(before.controls.throttle, after->controls.throttle);
  controls.brake = between(before.controls.brake, after->controls.brake);
  controls.clutch = between(before.controls.clutch, after->controls.clutch);
  controls.handbrake = between(before.controls.handbrake, after->controls.handbrake);
  return controls;
}

namespace {

class ScriptSource final : public Source {
 public:
  explicit ScriptSource(Script script) : script_(std::move(script)) {}
  Controls First() override { return script_.At(0.0); }
  base::Result<Controls> Step(const lockstep::StepInfo&, std::int64_t valid_ns, const lockstep::Inbox&) override {
    return script_.At(static_cast<double>(valid_ns) * 1e-9);
  }
  void Save(base::StateWriter&) const override {}  // a function of time alone
  void Restore(base::StateReader&) override {}
  void InitialiseFrom(const Controls&, const input_devices::Signals&) override {}

 private:
  Script script_;
};

}  // namespace

std::unique_ptr<Source> MakeScriptSource(Script script) { return std::make_unique<ScriptSource>(std::move(script)); }

}  // namespace rodeira::nodes
