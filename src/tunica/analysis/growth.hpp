// What became of an aorta between scans, told at the places of the first one.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tunica/analysis/scan_map.hpp"

namespace tunica::analysis {

/// The stretch between two branches, or between one of them and where the first scan that ends early ends.
struct GrowthSegment {
  std::string from, to;                       ///< branches; "inlet" and "end" for the ends
  double begin = 0, end = 0;                  ///< along the line of the first scan [m]
  std::vector<double> length;                 ///< of each scan [m]
  std::vector<std::array<double, 2>> volume;  ///< of true and false lumen, of each scan [m^3]
};

/// Tears of the scans at nearly the same place.
struct TearHistory {
  double s = 0;              ///< along the line of the first scan [m]
  std::vector<double> area;  ///< of each scan [m^2]; NaN where there is none
};

struct Growth {
  std::vector<ScanMap> maps;                        ///< from the first scan to each, itself included
  std::array<double, 2> range{};                    ///< along the line of the first scan, that all of them reach [m]
  std::vector<double> stations;                     ///< along the line of the first scan [m]
  std::vector<std::vector<AortaSection>> sections;  ///< [scan][station], their `s` in the scan itself
  std::vector<GrowthSegment> segments;
  std::vector<TearHistory> tears;  ///< downstream
};

/// Scans in order of their dates, which must outlive the result; their sections at equal distances give the stations.
/// Throws as ScanMap.
Growth find_growth(const std::vector<const Anatomy*>& scans);

/// By how much the edge of the lumens is farther from the line in `later` than in `earlier`, in the direction of `at`
/// of the first scan, as the map has it [m].
double radial_growth(const Growth& growth, const std::vector<const Anatomy*>& scans, std::size_t earlier,
                     std::size_t later, const LineCoordinates& at);

}  // namespace tunica::analysis
