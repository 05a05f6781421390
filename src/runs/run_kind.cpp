// SPDX-License-Identifier: GPL-3.0-or-later
// Both kinds of run, and earlier runs taken up again.
#include "mortise/runs/run_kind.hpp"

#include <charconv>
#include <chrono>

#include "mortise/core/errors.hpp"
#include "runs/option_table.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

template <class Number>
Number number_of(const std::string& name, const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError(name + ": expected a " + (std::is_integral_v<Number> ? "whole " : "") +
                     "number, got \"" + text + '"');
  return value;
}

bool switch_of(const std::string& name, const std::string& text) {
  if (text == "on" || text == "true") return true;
  if (text == "off" || text == "false") return false;
  throw InputError(name + ": expected on or off, got \"" + text + '"');
}

template <class Options>
void set_row(std::span<const OptionRow<Options>> rows, Options& options, const char* kind,
             const std::string& name, const std::string& text) {
  for (const OptionRow<Options>& row : rows) {
    if (name != row.name) continue;
    std::visit(
        [&](const auto& field) {
          if constexpr (std::is_same_v<std::decay_t<decltype(field)>, TextForm<Options>>) {
            field.parse(options, text);
          } else {
            auto& value = field(options);
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, std::string>)
              value = text;
            else if constexpr (std::is_same_v<Value, bool>)
              value = switch_of(name, text);
            else
              value = number_of<Value>(name, text);
          }
        },
        row.field);
    return;
  }
  throw InputError(name + " is no option of a " + kind + " run");
}

template <class Options>
SearchPlan plan_of(const RunKind<Options>& kind, const Run& run, const std::string& json,
                   const InputPlaces& places, int threads) {
  Options options = kind.parse(json);
  options.threads = threads;
  ReadBodyOptions reading = kind.reading(options);
  reading.threads = threads;
  const auto body = [&](const BodyRecord& record, const char* name, const LocateOptions& where) {
    return read_recorded_body(record, run.provenance, name, where, reading);
  };
  return kind.plan(body(run.fixed, "fixed", places.fixed),
                   body(run.moving, "moving", places.moving), options);
}

}  // namespace

const RunKind<DockOptions>& dock_kind() {
  static const RunKind<DockOptions> kind{
      "dock",
      dock_preset,
      dock_option_rows,
      [](const DockOptions& o) { return to_json(o); },
      parse_dock_options,
      [](const DockOptions& o) { return ReadBodyOptions{.molecule = o.read}; },
      [](const Body& a, const Body& b, const DockOptions& o) { return plan_dock(a, b, o); }};
  return kind;
}

const RunKind<MateOptions>& mate_kind() {
  static const RunKind<MateOptions> kind{
      "mate",
      mate_preset,
      mate_option_rows,
      [](const MateOptions& o) { return to_json(o); },
      parse_mate_options,
      [](const MateOptions& o) {
        ReadBodyOptions reading;
        reading.part.absolute_deviation = o.deviation;
        reading.part.repair.allow_open = o.allow_open;
        return reading;
      },
      [](const Body& a, const Body& b, const MateOptions& o) { return plan_mate(a, b, o); }};
  return kind;
}

void set_option(DockOptions& options, const std::string& name, const std::string& text) {
  set_row(dock_option_rows(), options, "docking", name, text);
}

void set_option(MateOptions& options, const std::string& name, const std::string& text) {
  set_row(mate_option_rows(), options, "mating", name, text);
}

void expect_same_options(const std::string& recorded, const std::string& asked,
                         const std::string& who) {
  const Json a = Json::parse(recorded), b = Json::parse(asked);
  const auto text = [](const Json& all, const std::string& key) {
    return all.contains(key) ? all[key].dump() : "nothing";
  };
  for (const Json* side : {&a, &b})
    for (const auto& item : side->items())
      if (text(a, item.key()) != text(b, item.key()))
        throw InputError(who + ": " + item.key() + " differs: the file was begun with " +
                         text(a, item.key()) + ", asked for now is " + text(b, item.key()));
}

SearchPlan plan_again(const Run& run, const std::string& options, const InputPlaces& places,
                      int threads) {
  if (run.kind == dock_kind().name) return plan_of(dock_kind(), run, options, places, threads);
  if (run.kind == mate_kind().name) return plan_of(mate_kind(), run, options, places, threads);
  throw InputError("a " + run.kind + " run is neither a docking nor a mating run");
}

Run rescore(const Run& run, const SearchPlan& plan) {
  if (run.candidates.empty()) throw InputError("rescore: the run holds no candidates");
  if (plan.rotations.size() != run.rotations.quaternions.cols() ||
      plan.rotations.quaternions != run.rotations.quaternions)
    throw InputError("rescore: the plan's rotations are not those of the run");
  const auto begin = std::chrono::steady_clock::now();
  Run result = run;
  result.provenance.options_json = plan.options;
  const RigidMotion search_from_moving = compose(run.moving.search_from_input, inverse(plan.start));
  RankedPoses ranked =
      rank_candidates(plan, run.candidates,
                      {run.rotations.quaternions, run.fixed.search_from_input, search_from_moving});
  result.poses = std::move(ranked.list);
  for (Pose& pose : result.poses.poses)
    pose.moving_in_fixed = compose(pose.moving_in_fixed, plan.start);
  result.metrics = plan_columns(plan, result);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  std::erase_if(result.figures, [](const Figure& figure) {
    return figure.name.starts_with("seconds_rank") || figure.name.starts_with("score_at_") ||
           figure.name == "seconds_describe";
  });
  for (Figure& figure : ranked.figures)
    if (!figure.name.starts_with("seconds")) result.figures.push_back(std::move(figure));
  result.figures.push_back({"seconds_rank", spent.count()});
  return result;
}

}  // namespace mortise
