// Times a stereo frame of the engine against the two-pass renderings and the naive rays it stands in for.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/compile/compile.h"
#include "tests/bench/gl_context.h"
#include "tests/bench/long_show.h"
#include "tests/bench/rays.h"
#include "tests/bench/retina_view.h"
#include "tests/bench/scenes.h"
#include "tests/bench/two_pass.h"

using namespace focalstage;
using namespace focalstage::bench;

namespace {

using Codes = std::vector<std::uint8_t>;

struct Variant {
  std::string name;
  std::function<void(Codes&)> frame;
  std::vector<double> times_ms{};
  std::vector<double> cpu_ms{};  ///< of all threads: what a busy machine does not lengthen
  Codes codes{};
};

double cpu_now_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void time_one(Variant& variant, Codes& codes) {
  const double cpu_before_ms = cpu_now_ms();
  const auto start = std::chrono::steady_clock::now();
  variant.frame(codes);
  variant.times_ms.push_back(
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  variant.cpu_ms.push_back(cpu_now_ms() - cpu_before_ms);
}

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

std::size_t bytes_off(const Codes& a, const Codes& b) {
  std::size_t off = 0;
  for (std::size_t i = 0; i < a.size(); ++i) off += std::abs(int{a[i]} - int{b[i]}) > 1 ? 1 : 0;
  return off;
}

double lit_share(const Codes& codes) {
  const auto lit = std::count_if(codes.begin(), codes.end(), [](std::uint8_t code) { return code > 0; });
  return static_cast<double>(lit) / static_cast<double>(codes.size());
}

/// The engine as a show uses it, to and fro between the scene and `other`: what stands still may be kept.
std::function<void(Codes&)> engine(const BenchScene& scene, const Stage& other, int threads = 0,
                                   VectorPath path = VectorPath::best) {
  const auto compiler = std::make_shared<Compiler>(scene.settings, threads, path);
  const auto turn = std::make_shared<bool>(false);
  return [&scene, &other, compiler, turn](Codes& codes) {
    *turn = !*turn;
    Result<CompiledFrame> frame = compiler->frame(*turn ? scene.stage : other);
    if (frame) codes = std::move(frame->images.codes);
  };
}

/// The engine with nothing known beforehand.
std::function<void(Codes&)> first_frame(const BenchScene& scene, int threads) {
  return [&scene, threads](Codes& codes) {
    Compiler compiler(scene.settings, threads);
    Result<CompiledFrame> frame = compiler.frame(scene.stage);
    if (frame) codes = std::move(frame->images.codes);
  };
}

Result<std::vector<Variant>> variants_of(const BenchScene& scene) {
  Result<std::shared_ptr<TwoPass>> passes = TwoPass::of(scene);
  if (!passes) return passes.fault();
  Result<std::shared_ptr<NaiveRays>> rays = NaiveRays::of(scene);
  if (!rays) return rays.fault();
  const auto two_pass = *passes;
  const auto naive = *rays;
  std::vector<Variant> all;
  all.push_back({"a1 two passes", [=](Codes& codes) { two_pass->frame(TwoPass::Passes::paper, codes); }});
  all.push_back({"a3 fused passes", [=](Codes& codes) { two_pass->frame(TwoPass::Passes::fused, codes); }});
  all.push_back({"b naive rays", [=](Codes& codes) { naive->frame(NaiveRays::Hits::anew, codes); }});
  all.push_back({"b, hits kept", [=](Codes& codes) { naive->frame(NaiveRays::Hits::kept, codes); }});
  all.push_back({"engine", engine(scene, scene.moved)});
  all.push_back({"engine, one moves", engine(scene, scene.one_moved)});
  all.push_back({"engine, first frame", first_frame(scene, 0)});
  all.push_back({"engine, 1 thread", engine(scene, scene.moved, 1)});
  all.push_back({"engine, portable", engine(scene, scene.moved, 0, VectorPath::portable)});
  return all;
}

Variant& named(std::vector<Variant>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const Variant& variant) { return variant.name == name; });
}

void print(const BenchScene& scene, std::vector<Variant>& all) {
  const Variant& rival = named(all, "a3 fused passes");
  const Variant& rays = named(all, "b naive rays");
  std::printf("\n%s: %.1f %% of the bytes lit\n", scene.name.c_str(), 100.0 * lit_share(rays.codes));
  std::printf("  %-22s %9s %9s %9s %9s %12s\n", "", "median ms", "a3 / it", "b / it", "cpu ms", "bytes off b");
  for (const Variant& variant : all) {
    const double ms = median(variant.times_ms);
    std::printf("  %-22s %9.1f %9.2f %9.2f %9.1f %12zu\n", variant.name.c_str(), ms, median(rival.times_ms) / ms,
                median(rays.times_ms) / ms, median(variant.cpu_ms), bytes_off(variant.codes, rays.codes));
  }
  const double one = median(named(all, "engine, 1 thread").times_ms);
  std::printf("  all threads are %.2f x one\n", one / median(named(all, "engine").times_ms));
}

Status run(int rounds, const std::string& only) {
  const Result<std::shared_ptr<GlContext>> gl = GlContext::make();
  if (!gl) return gl.fault();
  std::printf("2 eyes x 6 slices x 1024 x 768, medians of %d interleaved rounds; OpenGL: %s\n", rounds,
              (*gl)->renderer().c_str());
  for (const BenchScene& scene : bench_scenes()) {
    if (!only.empty() && scene.name != only) continue;
    Result<std::vector<Variant>> all = variants_of(scene);
    if (!all) return all.fault();
    for (Variant& variant : *all) variant.frame(variant.codes);  // warm, and of the stage that b shows
    Codes scratch;
    for (int round = 0; round < rounds; ++round) {
      for (Variant& variant : *all) time_one(variant, scratch);
    }
    print(scene, *all);
    std::fflush(stdout);
  }
  return {};
}

Status run_long_show(int frames) {
  const Result<LongShow> show = compile_long_show(frames);
  if (!show) return show.fault();
  std::printf("%d frames of 2 eyes x 3 slices x 1024 x 768 into a show\n", show->frames);
  std::printf("  one frame alone    %9.1f ms, %.1f ms on all threads\n", show->frame_ms, show->frame_cpu_ms);
  std::printf("  the show           %9.1f s, %.2f x its frames alone; %.1f s on all threads, %.2f x\n", show->show_s,
              show->slower(), show->show_cpu_s, show->show_cpu_s * 1e3 / (show->frame_cpu_ms * show->frames));
  std::printf("  memory at most     %9.0f MiB\n", show->most_memory_mib);
  std::printf("  size of the show   %9.1f MiB\n", show->show_mib);
  return {};
}

Status run_retina(int rounds, const std::string& only) {
  std::printf("one eye, 6 slices and a light image of 1024 x 768, one thread, medians of %d rounds, ms\n", rounds);
  std::printf("  %-10s %10s %14s %12s %12s\n", "", "size", "first picture", "head moved", "focus moved");
  for (const BenchScene& scene : bench_scenes()) {
    if (!only.empty() && scene.name != only) continue;
    for (const auto& [width_px, height_px] : {std::pair(400, 300), std::pair(512, 512)}) {
      const Result<RetinaTimes> times = time_retina(scene, width_px, height_px, rounds);
      if (!times) return times.fault();
      std::printf("  %-10s %4d x %3d %14.1f %12.1f %12.1f\n", scene.name.c_str(), width_px, height_px, times->first_ms,
                  times->head_ms, times->focus_ms);
    }
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  int rounds = 9;
  int show_frames = 0;
  bool retina = false;
  std::string only;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--rounds") == 0 && i + 1 < argc) {
      rounds = std::max(1, std::atoi(argv[++i]));
    } else if (std::strcmp(argv[i], "--scene") == 0 && i + 1 < argc) {
      only = argv[++i];
    } else if (std::strcmp(argv[i], "--show") == 0 && i + 1 < argc) {
      show_frames = std::max(1, std::atoi(argv[++i]));
    } else if (std::strcmp(argv[i], "--retina") == 0) {
      retina = true;
    } else {
      std::fprintf(stderr,
                   "usage: focalstage-bench [--retina] [--rounds N] [--scene bunnies|teapot|plane|bumpy]\n"
                   "       focalstage-bench --show FRAMES\n");
      return 2;
    }
  }
  const Status done = show_frames > 0 ? run_long_show(show_frames)
                      : retina        ? run_retina(rounds, only)
                                      : run(rounds, only);
  if (done) return 0;
  std::fprintf(stderr, "%s\n", describe(done.fault()).c_str());
  return 4;
}
