#include "devices/runtime/live_session.h"

#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

#include "devices/roles/clock.h"
#include "devices/roles/detection.h"
#include "io/protocol/convert.h"
#include "io/protocol/limits.h"
#include "io/protocol/silence_watch.h"

namespace focalstage {

namespace {

Fault vanished() {
  return {"rig.live-client", "live", "the editor that was live is not heard of any more",
          "see whether it still runs, then say go"};
}

/// A tenth less than the time by which it must be noticed: a busy machine wakes the watch late.
SilenceWatch::Clock::duration silence_allowed() {
  const std::chrono::duration<double> seconds(0.9 * detection_s(Doubt::live_client, 0.0));
  return std::chrono::duration_cast<SilenceWatch::Clock::duration>(seconds);
}

v1::LiveReply refusal(std::uint64_t revision, const Fault& fault) {
  v1::LiveReply reply;
  reply.mutable_refused()->set_revision(revision);
  *reply.mutable_refused()->mutable_fault() = message_from(fault);
  return reply;
}

v1::LiveReply compiled_reply(const LiveSnapshot& snapshot, const FrameImages& images, double compile_s) {
  v1::LiveReply reply;
  v1::LiveCompiled& compiled = *reply.mutable_compiled();
  compiled.set_revision(snapshot.revision);
  compiled.set_frame(snapshot.frame);
  compiled.set_compile_ms(1e3 * compile_s);
  compiled.set_images(static_cast<int>(images.count));
  compiled.set_width_px(images.width_px);
  compiled.set_height_px(images.height_px);
  compiled.set_channels(images.channels);
  return reply;
}

v1::LiveReply appeared_reply(const LiveSnapshot& snapshot, std::uint64_t sweep, double light_s) {
  v1::LiveReply reply;
  v1::LiveAppeared& appeared = *reply.mutable_appeared();
  appeared.set_revision(snapshot.revision);
  appeared.set_frame(snapshot.frame);
  appeared.set_sweep(sweep);
  appeared.set_edit_to_light_ms(1e3 * (light_s - snapshot.received_s));
  return reply;
}

}  // namespace

/// Hands the frame to the rig first; then whoever looks at it may. Where only bodies moved the editor is told nothing.
void LiveSession::present(const LiveSnapshot& snapshot, LiveMade made, bool share) {
  // Of the snapshot only the numbers go along: the rig's thread lets go of the show, and must not free a project.
  LiveSnapshot numbers = snapshot;
  numbers.project.reset();
  numbers.files.clear();
  const bool real_time = bench_.clock == RigClock::real_time;
  std::function<void(double light_s)> pose_lit = [](double) {};
  if (made.posed) {
    const double seen_s = made.posed->seen_s;
    const double taken_s = made.posed->taken_s;
    pose_lit = [=, delay = bench_.tracking->delay()](double light_s) { delay->lit(seen_s, taken_s, light_s); };
  }
  // Where bodies move a show may be overtaken before it was shown: the first in light speaks for its revision.
  if (made.first) appeared_ = std::make_shared<std::atomic<bool>>(false);
  made.show->on_light = [outbox = outbox_, appeared = appeared_, numbers, real_time, pose_lit](std::uint64_t sweep,
                                                                                               double start_s) {
    const double light_s = real_time ? start_s : monotonic_s();
    pose_lit(light_s);
    if (!appeared->exchange(true)) outbox->put(appeared_reply(numbers, sweep, light_s));
  };
  const PreparedFrames::Frame images = *made.show->frames->get(0);
  bench_.rig.present(std::move(made.show));
  if (bench_.tracking != nullptr) bench_.tracking->watch(made.posed ? made.posed->bodies : std::set<std::string>{});
  if (!made.first) return;
  v1::LiveReply reply = compiled_reply(snapshot, *images, made.compile_s);
  if (share) reply.mutable_compiled()->set_frame_file(bench_.frames.write(*images));
  outbox_->put(std::move(reply));
}

/// Says what is in the outbox, and every so often how the rig does.
void LiveSession::write() {
  using Clock = std::chrono::steady_clock;
  Clock::time_point next_state = Clock::now();
  while (!outbox_->closed()) {
    std::optional<v1::LiveReply> reply = outbox_->next(next_state);
    if (!reply && !outbox_->closed()) {
      reply.emplace();
      *reply->mutable_state() = bench_.state();
      next_state = Clock::now() + live_state_interval;
    }
    if (!reply || !stream_.Write(*reply)) return;
  }
}

grpc::Status LiveSession::run(const v1::LiveBegin& begin) {
  SilenceWatch silence(
      silence_allowed(),
      [this] {
        bench_.rig.doubt(vanished());
        context_.TryCancel();
      },
      prefer_this_thread);
  Result<End> ended = End::broken;
  {
    const std::jthread writer([this] { write(); });
    const bool share = begin.share_frames();
    LiveThread thread(
        bench_.assets, bench_.terms, bench_.tracking,
        {[this, share](const LiveSnapshot& snapshot, LiveMade made) { present(snapshot, std::move(made), share); },
         [this](std::uint64_t revision, const Fault& fault) {
           spdlog::warn("live: revision {} refused: {}", revision, describe(fault));
           outbox_->put(refusal(revision, fault));
         }});
    ended = listen(
        begin.token(), [&] { silence.heard(); }, thread);
    // Before anything here is waited for: light first.
    const bool said = ended && *ended == End::said;
    if (!said && !silence.fell_silent() && !bench_.stopping) bench_.rig.doubt(vanished());
    outbox_->close();
  }
  if (bench_.tracking != nullptr) bench_.tracking->watch({});
  return ended ? grpc::Status::OK : status_from(ended.fault());
}

/// Takes what the editor says until it says no more.
Result<LiveSession::End> LiveSession::listen(const std::string& token, const std::function<void()>& heard,
                                             LiveThread& thread) {
  v1::LiveRequest request;
  while (stream_.Read(&request)) {
    heard();
    if (Status mine = bench_.desk.use(token); !mine) return mine.fault();
    if (request.has_end()) return End::said;
    if (Status taken = take(request, thread); !taken) return taken.fault();
  }
  return End::broken;
}

Status LiveSession::take(const v1::LiveRequest& request, LiveThread& thread) {
  const double received_s = monotonic_s();
  switch (request.what_case()) {
    case v1::LiveRequest::kProject:
      return take(request.project(), received_s, thread);
    case v1::LiveRequest::kEdits:
      return take(request.edits(), received_s, thread);
    case v1::LiveRequest::kFrame:
      thread.add(FrameChange{received_s, request.frame().frame()});
      return {};
    case v1::LiveRequest::kChunk:
      return take(request.chunk(), thread);
    default:
      return {};  // a word, or one of a newer editor
  }
}

Status LiveSession::take(const v1::LiveProject& message, double received_s, LiveThread& thread) {
  v1::LiveWanted wanted;
  if (Status expected = arrivals_.expect(message.sha256(), message.size_bytes()); !expected) return expected;
  wanted.add_sha256(message.sha256());
  auto files = expect(message.assets(), wanted, thread);
  if (!files) return files.fault();
  thread.add(ProjectChange{message.revision(), received_s, message.sha256(), message.frame(), std::move(*files)});
  ask_for(std::move(wanted));
  return {};
}

Status LiveSession::take(const v1::LiveEdits& message, double received_s, LiveThread& thread) {
  v1::LiveWanted wanted;
  auto files = expect(message.assets(), wanted, thread);
  if (!files) return files.fault();
  thread.add(EditsChange{message.revision(),
                         received_s,
                         message.base_revision(),
                         {message.edits().begin(), message.edits().end()},
                         std::move(*files)});
  ask_for(std::move(wanted));
  return {};
}

Status LiveSession::take(const v1::LiveChunk& message, LiveThread& thread) {
  auto blob = arrivals_.add(message.sha256(), message.offset_bytes(), message.data());
  if (!blob) return blob.fault();
  if (*blob) thread.add(std::move(**blob));
  return {};
}

/// Which of the files must travel: those that neither a live link sent before nor the show that plays brought along.
Result<std::vector<LiveFile>> LiveSession::expect(const google::protobuf::RepeatedPtrField<v1::LiveAsset>& assets,
                                                  v1::LiveWanted& wanted, LiveThread& thread) {
  const std::shared_ptr<const LoadedShow> show = bench_.rig.show();
  std::vector<LiveFile> files;
  for (const v1::LiveAsset& asset : assets) {
    files.push_back({asset.path(), asset.sha256()});
    if (bench_.assets.has(asset.sha256())) continue;
    if (show) {
      const auto known = std::ranges::find(show->header.assets, asset.sha256(), &AssetFile::sha256);
      if (known != show->header.assets.end()) {
        const auto* bytes = reinterpret_cast<const char*>(known->bytes.data());
        thread.add(LiveBlob{asset.sha256(), {bytes, known->bytes.size()}});
        continue;
      }
    }
    if (Status expected = arrivals_.expect(asset.sha256(), asset.size_bytes()); !expected) return expected.fault();
    wanted.add_sha256(asset.sha256());
  }
  return files;
}

void LiveSession::ask_for(v1::LiveWanted wanted) {
  if (wanted.sha256().empty()) return;
  v1::LiveReply reply;
  *reply.mutable_wanted() = std::move(wanted);
  outbox_->put(std::move(reply));
}

}  // namespace focalstage
