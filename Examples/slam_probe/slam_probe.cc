#include <algorithm>
#include <iostream>

#include "semslam/base/stopwatch.h"
#include "semslam/config/settings.h"
#include "semslam/features/frame_builder.h"
#include "semslam/io/trajectory_io.h"
#include "semslam/io/tum_dataset.h"
#include "semslam/mapping/local_mapping.h"
#include "semslam/tracking/tracking.h"
using namespace semslam;
int main(int argc, char** argv) {
  if (argc < 6) return 1;
  Settings s = LoadSettings(argv[1]);
  TumDataset data(argv[2], argv[3], {});
  PinholeCamera camera(s.camera);
  FrameBuilder builder({}, camera, s.bf);
  SharedMap map;
  auto voc = std::make_shared<const Vocabulary>(Vocabulary::Load(argv[5]));
  Tracking::Options to;
  to.close_depth_m = s.CloseDepth();
  LocalMapping::Options mo;
  mo.close_depth_m = s.CloseDepth();
  Tracking tracking(to, camera, s.bf, voc, map);
  LocalMapping mapping(mo, camera, s.bf, voc, map);
  struct E {
    TimeNs t;
    KeyframeId k;
    Rigid3 T;
  };
  std::vector<E> entries;
  std::vector<double> te, tt, tm, tb;
  int lost = 0;
  while (auto image = data.Next()) {
    Stopwatch w;
    auto frame = std::make_shared<const Frame>(builder.Build(*image));
    te.push_back(w.Milliseconds());
    w.Restart();
    auto r = tracking.Track(frame, {});
    tt.push_back(w.Milliseconds());
    w.Restart();
    if (r.state == TrackingState::kTracking)
      entries.push_back({image->time, r.reference_keyframe, r.T_reference_camera});
    else
      ++lost;
    if (r.new_keyframe) {
      auto rep = mapping.Process(*r.new_keyframe, [] { return false; });
      tm.push_back(rep.total_seconds * 1e3);
      tb.push_back(rep.adjust_seconds * 1e3);
      if (argc > 6)
        std::cerr << "kf " << r.new_keyframe->value << " frame " << te.size() << " inl "
                  << r.num_inliers << " tri " << rep.num_triangulated << " fused " << rep.num_fused
                  << " culled " << rep.num_landmarks_culled << " kfc "
                  << rep.keyframes_culled.size() << " ms " << tm.back() << " ba " << tb.back()
                  << "\n";
      map.Read([](const Map& m) { m.CheckConsistency(); });
    }
  }
  Trajectory tr;
  map.Read([&](const Map& m) {
    for (auto& e : entries) tr.push_back({e.t, *m.ResolvePose(e.k) * e.T});
    std::cout << "keyframes " << m.num_keyframes() << " landmarks " << m.num_landmarks();
  });
  WriteTrajectory(argv[4], tr);
  auto med = [](std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v.empty() ? 0 : v[v.size() / 2];
  };
  std::cout << " frames " << te.size() << " lost " << lost << " extract " << med(te) << " track "
            << med(tt) << " map " << med(tm) << " ba " << med(tb) << " n " << tm.size() << "\n";
}
