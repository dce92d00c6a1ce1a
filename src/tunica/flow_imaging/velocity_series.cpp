#include "tunica/flow_imaging/velocity_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "tunica/base/error.hpp"

namespace tunica::flow_imaging {

namespace {

/// The last number in the name of a file, without its ending; empty when there is none.
std::string last_number(const std::string& file) {
  std::string name = std::filesystem::path(file).filename().string();
  name = name.substr(0, name.find('.', 1));  // .nii.gz is one ending
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  auto end = name.size();
  while (end > 0 && !digit(name[end - 1])) --end;
  auto begin = end;
  while (begin > 0 && digit(name[begin - 1])) --begin;
  return name.substr(begin, end - begin);
}

/// Speed that a share of all voxels and frames does not exceed, from every so many voxels, along one encoded axis
/// [m/s].
double largest_component(const VelocitySeries& series, double share) {
  std::vector<float> sizes;
  const auto stride = std::max<std::int64_t>(1, series.voxels() / 200000);
  for (const auto& of_frame : series.velocity)
    for (std::int64_t v = 0; v < series.voxels(); v += stride) {
      const auto at = static_cast<std::size_t>(v);
      const Vec3<double> u{{of_frame[0][at], of_frame[1][at], of_frame[2][at]}};
      double most = 0;
      for (const auto& axis : series.encoded) most = std::max(most, std::abs(dot(axis, u)));
      sizes.push_back(static_cast<float>(most));
    }
  if (sizes.empty()) return 0;
  const auto at = std::min(sizes.size() - 1, static_cast<std::size_t>(share * static_cast<double>(sizes.size())));
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(at), sizes.end());
  return sizes[at];
}

}  // namespace

std::vector<double> frame_times(const std::vector<double>& given, double period, const std::vector<std::string>& names,
                                const std::string& where, const std::string& item) {
  if (given.empty()) {
    std::vector<double> times;
    for (std::size_t k = 0; k < names.size(); ++k)
      times.push_back(period * static_cast<double>(k) / static_cast<double>(names.size()));
    return times;
  }
  if (given.size() != names.size())
    throw InputError(where, fmt::format("has {} times, and there are {} {}s", given.size(), names.size(), item),
                     "give one time for each " + item);
  for (std::size_t k = 1; k < given.size(); ++k) {
    if (given[k] > given[k - 1]) continue;
    const bool twice = given[k] == given[k - 1];
    throw InputError(
        where,
        twice ? fmt::format("{}s {} and {} both have the time {:.6g} s", item, names[k - 1], names[k], given[k])
              : fmt::format("{} {} of {:.6g} s stands behind {} {} of {:.6g} s", item, names[k], given[k], item,
                            names[k - 1], given[k - 1]),
        fmt::format("order the {}s by their times, each once", item));
  }
  if (given.front() < 0 || !(given.back() < period))
    throw InputError(where,
                     fmt::format("{}s from {:.6g} s to {:.6g} s do not lie within one period of {:.6g} s, from 0 on",
                                 item, given.front(), given.back(), period),
                     "give times since the trigger, and the period of the heart beat");
  return given;
}

std::vector<std::string> in_order_of_numbers(std::vector<std::string> files, const std::string& where,
                                             const std::string& item) {
  std::vector<std::pair<long long, std::string>> numbered;
  for (auto& file : files) {
    const auto number = last_number(file);
    if (number.empty() || number.size() > 12)
      throw InputError(where, fmt::format("{} has no number in its name that would tell its place", file),
                       fmt::format("number the {0}s: {0}_00.nrrd, {0}_01.nrrd, ...", item));
    numbered.emplace_back(std::stoll(number), std::move(file));
  }
  std::sort(numbered.begin(), numbered.end());
  for (std::size_t k = 1; k < numbered.size(); ++k) {
    const auto [before, first] = numbered[k - 1];
    const auto [number, second] = numbered[k];
    if (number == before)
      throw InputError(where, fmt::format("{} and {} are both {} {}", first, second, item, number),
                       "remove one of them");
    if (number != before + 1)
      throw InputError(where,
                       fmt::format("after {0} {1} ({2}) comes {0} {3} ({4})", item, before, first, number, second),
                       fmt::format("copy the {}s that are missing, or number them one after the other", item));
  }
  std::vector<std::string> ordered;
  for (auto& [number, file] : numbered) ordered.push_back(std::move(file));
  return ordered;
}

void check_plausible(const VelocitySeries& series, const std::string& where) {
  // Blood in an aorta: 0.1 to 5 m/s at its peak. Noise of air reaches the encoding velocity, rarely more.
  constexpr double slowest = 0.02, fastest = 12;
  const double most = largest_component(series, 0.9999);
  if (!(most >= slowest && most <= fastest)) {
    const char* meant = most > 0 && most < slowest ? "m/s in place of cm/s, or cm/s in place of mm/s" : "cm/s or mm/s";
    throw InputError(where, fmt::format("makes the largest velocities {:.3g} m/s, which are none of blood", most),
                     fmt::format("correct the unit: perhaps {}", most == 0 ? "the file holds no velocities" : meant));
  }
  if (!series.encoding) return;
  if (most > 1.05 * *series.encoding)
    throw InputError(where,
                     fmt::format("makes the largest velocities {:.3g} m/s, beyond the encoding velocity of {:.3g} m/s",
                                 most, *series.encoding),
                     "correct the unit or `encoding`; leave `encoding` out for velocities that were unwrapped already");
  if (most < 0.05 * *series.encoding)
    throw InputError(where,
                     fmt::format("makes the largest velocities {:.3g} m/s, a small part of the encoding velocity of "
                                 "{:.3g} m/s",
                                 most, *series.encoding),
                     "correct the unit or `encoding`");
}

Vec3<double> velocity_at(const VelocitySeries& series, std::size_t frame, const Point& place) {
  const auto& f = series.frame;
  const Point at = inverse(f.matrix()) * (place - f.origin);
  std::int64_t low[3];
  double share[3];
  for (int d = 0; d < 3; ++d) {
    const double most = static_cast<double>(f.size[static_cast<std::size_t>(d)] - 1);
    const double x = std::clamp(at[d], 0.0, most);
    low[d] = std::min(static_cast<std::int64_t>(x), f.size[static_cast<std::size_t>(d)] - 2);
    share[d] = x - static_cast<double>(low[d]);
  }
  Vec3<double> v{};
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::int64_t voxel[3];
    for (int d = 0; d < 3; ++d) {
      const int up = corner >> d & 1;
      weight *= up ? share[d] : 1 - share[d];
      voxel[d] = low[d] + up;
    }
    const auto index = static_cast<std::size_t>(f.index(voxel[0], voxel[1], voxel[2]));
    for (int c = 0; c < 3; ++c)
      v[c] += weight * static_cast<double>(series.velocity[frame][static_cast<std::size_t>(c)][index]);
  }
  return v;
}

}  // namespace tunica::flow_imaging
