#pragma once

#include <string>

#include "extract/pose/network_points.h"
#include "tests/calibrate/rendered.h"

namespace stride {

/// What the pose network makes of a shipped clip without a click, against the truth.
struct ZeroClicks {
  Calibration found;
  int frames = 0, lost = 0;  // of the clip
  int exchanged = 0;         // after tracking: right and left lie nearer to each other's truth
  double leg_px = 0;         // median length of the true thigh and shank
  // Rms of the network's own points, and after tracking.
  double knees_px[2]{}, ankles_px[2]{}, toes_px[2]{}, heels_px[2]{};

  /// A row of the page's table; `table_head()` stands above the rows.
  std::string row(const videos::Clip& clip, const SagittalModel& model) const;
  static std::string table_head();
};

/// What is done with the heels that the network sees.
enum class SeenHeels { fitted, tracked, dropped };
inline constexpr Names<SeenHeels> kSeenHeels({{SeenHeels::fitted, "fitted"},
                                              {SeenHeels::tracked, "tracked"},
                                              {SeenHeels::dropped, "dropped"}});

ZeroClicks without_clicks(const videos::Clip& clip, const SagittalModel& model,
                          const pose::NetworkPoints& seen, SeenHeels heels);
pose::NetworkPoints seen_by_network(const videos::Clip& clip);

/// The network's points with a few corrections, as `stride annotate --pose` asks for them (worst
/// point first, a hand's noise), beside one stride clicked whole: 63 clicks on nine frames. A row
/// of the page's table with the worst joint of each fit, cm.
std::string correction_row(const videos::Clip& clip, const SagittalModel& model);
std::string correction_head();

}  // namespace stride
