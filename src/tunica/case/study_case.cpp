#include "tunica/case/study_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "tunica/analysis/sampling.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/descriptions.hpp"

namespace tunica::case_file {

namespace {

using config::Problems;
using config::Schema;

void check_key(const VariedKey& k, Problems& problems) {
  const bool range = k.from || k.to || k.count;
  if (k.values.empty() + !range + k.between.empty() != 2)
    problems.add("", "has none or several of: a list of values, from/to/count, between",
                 "give one: `[1 mm, 2 mm]`, `{from: 1 mm, to: 3 mm, count: 5}`, `{between: [1 mm, 3 mm]}`");
  if (range && !(k.from && k.to && k.count))
    problems.add("", "lacks one of from, to and count", "write `{from: 1 mm, to: 3 mm, count: 5}`");
  if (!k.between.empty() && k.between.size() != 2)
    problems.add("between", fmt::format("has {} entries", k.between.size()), "write `between: [1 mm, 3 mm]`");
  if (k.scale == Spacing::log && !k.values.empty())
    problems.add("scale", "means nothing for a list of values", "remove it");
}

Schema<VariedKey> varied_key_schema() {
  return Schema<VariedKey>("values", "The values of one key.")
      .texts("values", &VariedKey::values, "List of values, each as the case would have it")
      .by_default()
      .text("from", &VariedKey::from, "First of `count` values, with its unit")
      .text("to", &VariedKey::to, "Last of them, in the same unit")
      .integer("count", &VariedKey::count, config::range(2, 10000), "How many, ends included")
      .texts("between", &VariedKey::between, "Ends of the range that a sampled design takes values from, in one unit")
      .by_default()
      .choice("scale", &VariedKey::scale, {{"linear", Spacing::linear}, {"log", Spacing::log}},
              "Equal differences or equal ratios, also of what is sampled")
      .by_default()
      .shorthand("values")
      .check(check_key);
}

template <class D>
Schema<D> sampled_schema(const std::string& name, const std::string& help, const std::string& points) {
  return Schema<D>(name, help)
      .integer("points", &D::points, config::range(2, 10000), points)
      .integer("seed", &D::seed, config::at_least(0), "Of the random numbers; the same one gives the same points")
      .by_default();
}

Schema<Design> design_schema() {
  return Schema<Design>("design", "How the points follow from the values.")
      .one_of()
      .alternative(Schema<GridDesign>("grid", "Every value of each key with every value of all others."))
      .alternative(Schema<ListDesign>("list", "The first values of all keys, then the second ones, and so on."))
      .alternative(sampled_schema<LatinHypercubeDesign>(
          "latin_hypercube", "One point in each of `points` equal slices of every range.", "How many"))
      .alternative(sampled_schema<SobolDesign>(
          "sobol", "Sobol's sequence, its binary digits shifted at random; a power of two covers most evenly.",
          "How many"))
      .alternative(sampled_schema<SaltelliDesign>(
          "saltelli", "Blocks for Sobol indices: `points` times the number of keys plus two.",
          "Of each block; a power of two"));
}

std::string with_dots(std::string key) {
  std::replace(key.begin(), key.end(), '/', '.');
  return key;
}

// --- values of a key ------------------------------------------------------------------------------------------------

std::string number_text(double number, const std::string& unit) {
  return fmt::format("{:.10g}{}{}", number, unit.empty() ? "" : " ", unit);
}

/// Between two ends, at `share` of the way in [0, 1].
double between(double low, double high, double share, Spacing scale) {
  return scale == Spacing::log ? low * std::pow(high / low, share) : low + (high - low) * share;
}

/// An axis with the ends that it has, if any, and the values that do not depend on a sample.
struct Values {
  VariedAxis axis;
  Spacing scale = Spacing::linear;
  double low = 0, high = 0;
  std::vector<std::string> texts{};
  std::vector<double> numbers{};
};

void read_ends(const std::string& where, const std::string& first, const std::string& last, Values& values,
               std::vector<Problem>& problems) {
  const auto low = number_and_unit(first), high = number_and_unit(last);
  if (!low || !high) {
    problems.push_back({where, fmt::format("`{}` is no number", low ? last : first), "write a number with its unit"});
    return;
  }
  if (low->second != high->second)
    problems.push_back(
        {where, fmt::format("`{}` and `{}` have different units", first, last), "write both in one unit"});
  if (!(low->first < high->first))
    problems.push_back({where, fmt::format("`{}` is not below `{}`", first, last), "give the smaller one first"});
  if (values.scale == Spacing::log && !(low->first > 0))
    problems.push_back(
        {where, fmt::format("`{}` has no logarithm", first), "begin above 0, or leave out `scale: log`"});
  values.axis.numeric = true;
  values.axis.unit = low->second;
  values.low = low->first, values.high = high->first;
}

/// Values that stand in the file.
void take_list(const std::vector<std::string>& given, Values& values) {
  values.texts = given;
  std::vector<double> numbers;
  for (const auto& text : given) {
    const auto number = number_and_unit(text);
    if (!number || (!numbers.empty() && number->second != values.axis.unit)) break;
    values.axis.unit = number->second;
    numbers.push_back(number->first);
  }
  values.axis.numeric = numbers.size() == given.size();
  if (!values.axis.numeric) {
    values.axis.unit.clear();
    numbers.clear();
    for (const auto& text : given)
      numbers.push_back(1.0 + static_cast<double>(std::find(given.begin(), given.end(), text) - given.begin()));
  }
  values.numbers = std::move(numbers);
}

Values values_of(const std::string& key, const VariedKey& given, bool sampled, std::vector<Problem>& problems) {
  const std::string where = "vary." + key;
  Values values{.axis = {.key = with_dots(key), .log = given.scale == Spacing::log}, .scale = given.scale};
  if (sampled != !given.between.empty()) {
    problems.push_back({where,
                        sampled ? "has no `between`, which a sampled design takes its values from"
                                : "has a range to sample from, but the design does not sample",
                        sampled ? "write `{between: [1 mm, 3 mm]}`, or choose `design: grid`"
                                : "write `design: {sobol: {points: 16}}`, or a list of values"});
    return values;
  }
  if (sampled) {
    read_ends(where, given.between[0], given.between[1], values, problems);
  } else if (given.from) {
    read_ends(where, *given.from, *given.to, values, problems);
    for (int k = 0; k < *given.count; ++k) {
      values.numbers.push_back(between(values.low, values.high, k / (*given.count - 1.0), given.scale));
      values.texts.push_back(number_text(values.numbers.back(), values.axis.unit));
    }
  } else {
    take_list(given.values, values);
  }
  return values;
}

// --- points ---------------------------------------------------------------------------------------------------------

constexpr std::size_t most_points = 10000;

void refuse_too_many(double points) {
  if (points > static_cast<double>(most_points))
    throw InputError("design", fmt::format("has {:.0f} points", points),
                     fmt::format("give at most {}: fewer values, or `design: {{sobol: {{points: 64}}}}`", most_points));
}

std::vector<StudyPoint> grid_points(const std::vector<Values>& values) {
  double count = 1;
  for (const auto& v : values) count *= static_cast<double>(v.texts.size());
  refuse_too_many(count);
  std::vector<StudyPoint> points(1);
  for (const auto& v : values) {
    std::vector<StudyPoint> longer;
    for (const auto& point : points)
      for (std::size_t k = 0; k < v.texts.size(); ++k) {
        longer.push_back(point);
        longer.back().values.push_back(v.texts[k]);
        longer.back().numbers.push_back(v.numbers[k]);
      }
    points = std::move(longer);
  }
  return points;
}

std::vector<StudyPoint> list_points(const std::vector<Values>& values) {
  const std::size_t count = values[0].texts.size();
  for (const auto& v : values)
    if (v.texts.size() != count)
      throw InputError("vary." + v.axis.key,
                       fmt::format("has {} values, and {} has {}", v.texts.size(), values[0].axis.key, count),
                       "give all keys as many values, or choose `design: grid`");
  std::vector<StudyPoint> points(count);
  for (std::size_t k = 0; k < count; ++k)
    for (const auto& v : values) {
      points[k].values.push_back(v.texts[k]);
      points[k].numbers.push_back(v.numbers[k]);
    }
  return points;
}

std::vector<StudyPoint> sampled_points(const std::vector<Values>& values, const analysis::UnitPoints& unit) {
  std::vector<StudyPoint> points;
  for (const auto& row : unit) {
    auto& point = points.emplace_back();
    for (std::size_t d = 0; d < values.size(); ++d) {
      const auto& v = values[d];
      point.values.push_back(number_text(between(v.low, v.high, row[d], v.scale), v.axis.unit));
      point.numbers.push_back(number_and_unit(point.values.back())->first);  // what the case holds, digit for digit
    }
  }
  return points;
}

struct MakePoints {
  const std::vector<Values>& values;

  std::vector<StudyPoint> operator()(const GridDesign&) const { return grid_points(values); }
  std::vector<StudyPoint> operator()(const ListDesign&) const { return list_points(values); }
  std::vector<StudyPoint> operator()(const LatinHypercubeDesign& d) const {
    return sampled_points(values, analysis::latin_hypercube(count(d.points), values.size(), seed(d.seed)));
  }
  std::vector<StudyPoint> operator()(const SobolDesign& d) const {
    return sampled_points(values, analysis::shifted_sobol_sequence(count(d.points), values.size(), seed(d.seed)));
  }
  std::vector<StudyPoint> operator()(const SaltelliDesign& d) const {
    refuse_too_many(d.points * (static_cast<double>(values.size()) + 2));
    return sampled_points(values, analysis::saltelli_points(count(d.points), values.size(), seed(d.seed)));
  }
  static std::size_t count(int points) { return static_cast<std::size_t>(points); }
  static std::uint64_t seed(std::int64_t given) { return static_cast<std::uint64_t>(given); }
};

void refuse_equal(const StudyPoints& study) {
  std::map<std::vector<std::string>, std::size_t> first;
  std::vector<Problem> problems;
  for (std::size_t k = 0; k < study.points.size(); ++k) {
    // Numbers are compared as such: 1 mm is 1.0 mm.
    std::vector<std::string> same = study.points[k].values;
    for (std::size_t d = 0; d < same.size(); ++d)
      if (study.axes[d].numeric) same[d] = fmt::format("{}", study.points[k].numbers[d]);
    const auto [at, fresh] = first.emplace(std::move(same), k);
    if (!fresh)
      problems.push_back({fmt::format("point {}", k + 1),
                          fmt::format("is point {} again: {}", at->second + 1, study.points[k].text(study.axes)),
                          "give every value once"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

Schema<StudyCase> StudyCase::schema() {
  return Schema<StudyCase>("study", "A study of parameters: one case with other values of some of its keys.")
      .text("title", &StudyCase::title, "Of the page of results")
      .by_default()
      .file("case", &StudyCase::case_file, "The case file that is varied; it needs the section `post`")
      .map(
          "vary", &StudyCase::vary, varied_key_schema(),
          "Values by key of the case, as in `wall.density: [1000 kg/m^3, 1100 kg/m^3]`. Paths count from the folder of "
          "the case")
      .section("design", &StudyCase::design, design_schema(), "How the points follow from the values")
      .by_default("grid")
      .texts("quantities", &StudyCase::quantities,
             "Patterns of the figures to look at, as paths in post.json; none: those of `tunica converge`")
      .by_default()
      .path("output", &StudyCase::output, "Folder of the results, relative to that of the file")
      .by_default("study")
      .check([](const StudyCase& s, Problems& problems) {
        if (s.vary.empty()) problems.add("vary", "names no key", "add one, as in `time.step: [1 ms, 2 ms]`");
      });
}

config::Parsed<StudyCase> read_study_case(const std::filesystem::path& file) {
  return config::parse_file(StudyCase::schema(), file);
}

std::shared_ptr<const config::Description> study_description() { return StudyCase::schema().description(); }

std::optional<std::pair<double, std::string>> number_and_unit(const std::string& text) {
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* const end = text.data() + text.size();
  double number = 0;
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
  const std::string after(rest, end);
  const auto unit = after.find_first_not_of(' ');
  return std::pair{number, unit == std::string::npos ? "" : after.substr(unit)};
}

std::string VariedAxis::label() const { return unit.empty() ? key : fmt::format("{} [{}]", key, unit); }

std::string StudyPoint::text(const std::vector<VariedAxis>& axes) const {
  std::string all;
  for (std::size_t k = 0; k < axes.size(); ++k)
    all += fmt::format("{}{} = {}", k == 0 ? "" : ", ", axes[k].key, values[k]);
  return all;
}

StudyPoints study_points(const StudyCase& study) {
  const bool sampled = study.design.index() >= 2;
  std::vector<Problem> problems;
  std::vector<Values> values;
  StudyPoints result;
  for (const auto& [key, given] : study.vary) {
    values.push_back(values_of(key, given, sampled, problems));
    result.axes.push_back(values.back().axis);
    for (std::size_t k = 0; k + 1 < result.axes.size(); ++k)
      if (result.axes[k].key == with_dots(key))
        problems.push_back({"vary." + key, "stands twice, with dots and with slashes", "keep one of them"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  result.points = std::visit(MakePoints{values}, study.design);
  refuse_equal(result);
  return result;
}

}  // namespace tunica::case_file
