#include "devices/runtime/rig_service.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include <spdlog/spdlog.h>

#include "devices/runtime/live_session.h"
#include "devices/runtime/part_report.h"
#include "devices/runtime/show_loader.h"
#include "io/protocol/convert.h"

namespace focalstage {

namespace {

/// Each has a thread of its own.
constexpr int most_watchers = 64;

/// One more of something, as long as it is there.
class Counted {
 public:
  explicit Counted(std::atomic<int>& count) : count_(count) { ++count_; }
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  std::atomic<int>& count_;
};

Fault bad_digest(int chunk) {
  return {"rig.request", "chunk_sha256 " + std::to_string(chunk), "it has not 32 bytes",
          "push with this program's client"};
}

}  // namespace

/// A fault leaves as a status, and stays in the log and the count.
grpc::Status RigService::refused(const char* call, const Fault& fault) {
  refusals_.count(fault.code);
  spdlog::warn("{}: {}", call, describe(fault));
  return status_from(fault);
}

RigState RigService::values() const {
  RigState state = rig_.state();
  state.holder = desk_.holder();
  if (tracking_ != nullptr) {
    state.pose_to_light_ms = 1e3 * tracking_->delay()->pose_to_light_s();
    state.parts.push_back(report_of(tracking_->part()));
  }
  if (const auto& sensor = settings_.rig.light_sensor)
    state.parts.push_back(report_of({sensor->id(), sensor->state()}));
  return state;
}

RuntimeFigures RigService::figures() const {
  RuntimeFigures figures;
  figures.state = values();
  figures.push_bytes = push_bytes_;
  figures.watchers = watchers_;
  figures.faults = rig_.faults().counts();
  for (const auto& [code, count] : refusals_.counts()) figures.faults[code] += count;
  return figures;
}

RigTerms RigService::terms() const {
  return {[this](double hz) { return measured_.describe(hz); }, settings_.limits, settings_.models};
}

Status RigService::operate(const DeskCommand& command, bool despite_lease) {
  using Kind = DeskCommand::Kind;
  const std::string holder = desk_.holder();
  const auto obey = [&]() -> Status {
    if (command.kind != Kind::blackout && !despite_lease && !holder.empty()) {
      return Fault{"rig.held", holder, "an editor holds the rig", "wait until it lets go; blackout is always obeyed"};
    }
    if (command.kind != Kind::blackout) {
      if (Status free = not_measuring(); !free) return free;
    }
    switch (command.kind) {
      case Kind::play:
        return rig_.play(0);
      case Kind::hold:
        return rig_.hold();
      case Kind::cue:
        return rig_.cue(command.cue);
      case Kind::next:
        return rig_.next();
      case Kind::back:
        return rig_.back();
      case Kind::go:
        return rig_.go();
      case Kind::blackout:
        rig_.blackout();
        spdlog::warn("blackout by a control desk");
        return {};
    }
    return {};
  };
  Status done = obey();
  if (!done) (void)refused("desk", done.fault());
  return done;
}

/// What needs the rig for oneself: the token first, then the step, then the state after it.
template <class Step>
grpc::Status RigService::held(const grpc::ServerContext* context, const std::string& token, v1::RigState* reply,
                              Step step) {
  if (Status may = guard_.admit(*context, Right::control); !may) return refused("command", may.fault());
  if (Status mine = desk_.use(token); !mine) return status_from(mine.fault());
  if (Status free = not_measuring(); !free) return refused("command", free.fault());
  if (Status done = step(); !done) return refused("command", done.fault());
  *reply = state();
  return grpc::Status::OK;
}

/// Waits until the chunk's bytes are paid for.
void RigService::keep_pace(const grpc::ServerContext& context, std::size_t bytes) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point until = Clock::now() + push_pace_.owe(static_cast<double>(bytes));
  while (!stopping_ && !context.IsCancelled() && Clock::now() < until) {
    std::this_thread::sleep_for(std::min<Clock::duration>(until - Clock::now(), std::chrono::milliseconds(50)));
  }
}

grpc::Status RigService::Describe(grpc::ServerContext* context, const v1::DescribeRequest* request,
                                  v1::RigDescription* reply) {
  if (Status may = guard_.admit(*context, Right::watch); !may) return refused("describe", may.fault());
  const double asked_hz = request->frequency_hz();
  const double frequency_hz = std::isfinite(asked_hz) && asked_hz > 0.0 ? asked_hz : 60.0;
  *reply = message_from(measured_.describe(frequency_hz));
  return grpc::Status::OK;
}

grpc::Status RigService::Acquire(grpc::ServerContext* context, const v1::AcquireRequest* request, v1::Lease* reply) {
  if (Status may = guard_.admit(*context, Right::push); !may) {
    if (Status also = guard_.admit(*context, Right::control); !also) return refused("acquire", also.fault());
  }
  Result<std::string> token = desk_.acquire(request->holder());
  if (!token) return status_from(token.fault());
  spdlog::info("{} holds the rig", desk_.holder());
  reply->set_token(std::move(*token));
  reply->set_expires_in_s(std::chrono::duration<double>(desk_.lasts()).count());
  return grpc::Status::OK;
}

grpc::Status RigService::Release(grpc::ServerContext* context, const v1::ReleaseRequest* request, v1::ReleaseReply*) {
  if (Status may = guard_.admit(*context, Right::push); !may) {
    if (Status also = guard_.admit(*context, Right::control); !also) return refused("release", also.fault());
  }
  desk_.release(request->token());
  return grpc::Status::OK;
}

grpc::Status RigService::BeginPush(grpc::ServerContext* context, const v1::BeginPushRequest* request,
                                   v1::PushProgress* reply) {
  if (Status may = guard_.admit(*context, Right::push); !may) return refused("push", may.fault());
  if (Status mine = desk_.use(request->token()); !mine) return status_from(mine.fault());
  std::vector<Sha256Value> chunks(static_cast<std::size_t>(request->chunk_sha256_size()));
  for (int i = 0; i < request->chunk_sha256_size(); ++i) {
    const std::string& bytes = request->chunk_sha256(i);
    Sha256Value& digest = chunks[static_cast<std::size_t>(i)];
    if (bytes.size() != digest.size()) return refused("push", bad_digest(i));
    std::ranges::transform(bytes, digest.begin(), [](char c) { return static_cast<std::uint8_t>(c); });
  }
  const auto progress = store_.begin(request->sha256(), request->size_bytes(), std::move(chunks));
  if (!progress) return refused("push", progress.fault());
  spdlog::info("push of {}: {} of {} bytes are here", request->sha256(), progress->received_bytes,
               request->size_bytes());
  reply->set_received_bytes(progress->received_bytes);
  reply->set_complete(progress->complete);
  return grpc::Status::OK;
}

grpc::Status RigService::PushChunk(grpc::ServerContext* context, const v1::PushChunkRequest* request,
                                   v1::PushProgress* reply) {
  if (Status may = guard_.admit(*context, Right::push, false); !may) return refused("push", may.fault());
  if (Status mine = desk_.use(request->token()); !mine) return status_from(mine.fault());
  keep_pace(*context, request->data().size());
  const auto progress = store_.add(request->sha256(), request->offset_bytes(), request->data());
  if (!progress) return refused("push", progress.fault());
  push_bytes_ += request->data().size();
  reply->set_received_bytes(progress->received_bytes);
  reply->set_complete(progress->complete);
  return grpc::Status::OK;
}

grpc::Status RigService::FinishPush(grpc::ServerContext* context, const v1::FinishPushRequest* request,
                                    v1::PushVerified* reply) {
  if (Status may = guard_.admit(*context, Right::push); !may) return refused("push", may.fault());
  if (Status mine = desk_.use(request->token()); !mine) return status_from(mine.fault());
  const auto show = store_.finish(request->sha256());
  if (!show) return refused("push", show.fault());
  (void)desk_.use(request->token());  // reading it may have taken longer than the lease lasts
  reply->set_frames(show->frames);
  reply->set_images(show->images);
  spdlog::info("push of {} is whole and verified", request->sha256());
  return grpc::Status::OK;
}

grpc::Status RigService::Activate(grpc::ServerContext* context, const v1::ActivateRequest* request,
                                  v1::RigState* reply) {
  return held(context, request->token(), reply, [&]() -> Status {
    const auto path = store_.find(request->sha256());
    if (!path) return path.fault();
    auto show = load_show(*path, request->sha256(), terms());
    if (!show) return show.fault();
    if (Status active = rig_.activate(std::move(*show)); !active) return active;
    spdlog::info("show {} is active", request->sha256());
    return {};
  });
}

grpc::Status RigService::Play(grpc::ServerContext* context, const v1::PlayRequest* request, v1::RigState* reply) {
  return held(context, request->token(), reply, [&] { return rig_.play(request->sweeps()); });
}

grpc::Status RigService::Hold(grpc::ServerContext* context, const v1::HoldRequest* request, v1::RigState* reply) {
  return held(context, request->token(), reply, [&] { return rig_.hold(); });
}

grpc::Status RigService::Cue(grpc::ServerContext* context, const v1::CueRequest* request, v1::RigState* reply) {
  return held(context, request->token(), reply, [&] { return rig_.cue(request->name()); });
}

grpc::Status RigService::Next(grpc::ServerContext* context, const v1::NextRequest* request, v1::RigState* reply) {
  return held(context, request->token(), reply, [&] { return rig_.next(); });
}

grpc::Status RigService::Back(grpc::ServerContext* context, const v1::BackRequest* request, v1::RigState* reply) {
  return held(context, request->token(), reply, [&] { return rig_.back(); });
}

grpc::Status RigService::Go(grpc::ServerContext* context, const v1::GoRequest* request, v1::RigState* reply) {
  return held(context, request->token(), reply, [&] { return rig_.go(); });
}

grpc::Status RigService::Blackout(grpc::ServerContext* context, const v1::BlackoutRequest*, v1::RigState* reply) {
  if (Status may = guard_.admit(*context, Right::watch); !may) return refused("blackout", may.fault());
  rig_.blackout();
  spdlog::warn("blackout");
  *reply = state();
  return grpc::Status::OK;
}

grpc::Status RigService::GetState(grpc::ServerContext* context, const v1::GetStateRequest*, v1::RigState* reply) {
  if (Status may = guard_.admit(*context, Right::watch); !may) return refused("state", may.fault());
  *reply = state();
  return grpc::Status::OK;
}

grpc::Status RigService::Watch(grpc::ServerContext* context, const v1::WatchRequest* request,
                               grpc::ServerWriter<v1::RigState>* writer) {
  if (Status may = guard_.admit(*context, Right::watch); !may) return refused("watch", may.fault());
  using namespace std::chrono;
  const Counted watching(watchers_);
  if (watchers_ > most_watchers) {
    return refused("watch", {"rig.busy", "watch", "too many watch this rig", "let others end their watching"});
  }
  const double asked_s = request->interval_s();
  const double interval_s = std::isfinite(asked_s) && asked_s > 0.0 ? std::clamp(asked_s, 0.01, 10.0) : 0.1;
  const auto interval = duration_cast<milliseconds>(duration<double>(interval_s));
  while (!stopping_ && !context->IsCancelled() && writer->Write(state())) {
    const auto next = steady_clock::now() + interval;
    while (!stopping_ && !context->IsCancelled() && steady_clock::now() < next) {
      std::this_thread::sleep_for(std::min(interval, milliseconds(50)));
    }
  }
  return grpc::Status::OK;
}

grpc::Status RigService::Live(grpc::ServerContext* context,
                              grpc::ServerReaderWriter<v1::LiveReply, v1::LiveRequest>* stream) {
  for (const Right needed : {Right::push, Right::control}) {
    if (Status may = guard_.admit(*context, needed); !may) return refused("live", may.fault());
  }
  v1::LiveRequest first;
  if (!stream->Read(&first) || !first.has_begin()) {
    return refused("live", {"rig.request", "begin", "a live link begins with the token", "say begin first"});
  }
  if (Status mine = desk_.use(first.begin().token()); !mine) return status_from(mine.fault());
  if (live_.exchange(true)) {
    return refused("live", {"rig.refused", "live", "a live link is open already", "end that one first"});
  }
  if (Status free = not_measuring(); !free) {
    live_ = false;
    return refused("live", free.fault());
  }
  const Counted watching(watchers_);
  spdlog::info("{} is live", desk_.holder());
  LiveBench bench{rig_,     desk_, assets_, tracking_, frames_, terms(), settings_.clock, [this] { return state(); },
                  stopping_};
  grpc::Status ended = LiveSession(bench, *context, *stream).run(first.begin());
  live_ = false;
  spdlog::info("the live link has ended");
  return ended;
}

}  // namespace focalstage
