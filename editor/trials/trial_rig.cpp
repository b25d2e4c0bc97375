#include "editor/trials/trial_rig.h"

namespace focalstage {
namespace {

constexpr std::chrono::milliseconds deadline{3000};

// A lease lasts 10 s after its holder was last heard of.
constexpr std::chrono::milliseconds held_every{2000};

Fault latched(const std::string& rig, const RigState& state) {
  return {"rig.dark", rig, state.fault.empty() ? "the rig was blacked out" : "the rig went dark: " + state.fault,
          "see why, then let it go on"};
}

/// What a state has that it should not have.
Status expect(const RigState& state, const std::string& sha256, const std::optional<ShownTarget>& shown,
              const std::string& rig) {
  if (state.state == "dark") return latched(rig, state);
  if (state.show_sha256 != sha256) {
    return Fault{"rig.other-show", rig, "the rig has another show than this trial's",
                 "see that nobody else uses the rig or started it anew"};
  }
  if (!shown) {
    if (state.state == "ready") return {};
    return Fault{"rig.not-dark", rig, "the rig shows something between trials", "see that nobody else uses the rig"};
  }
  if (state.state == "holding" && state.frame == shown->frame) return {};
  return Fault{"rig.light-lost", rig,
               "the rig does not show the target any more (it is " + state.state + ", frame " +
                   std::to_string(state.frame) + ")",
               "see that nobody else uses the rig"};
}

}  // namespace

Status ProtocolTrialRig::connect(bool lift) {
  client_.reset();  // gives back what it held
  shown_.reset();
  sha256_.clear();
  auto client = RigClient::connect(host_port_, deadline);
  if (!client) return client.fault();
  const auto description = client->describe();
  if (!description) return description.fault();
  kind_ = description->kind;
  const auto state = client->state();
  if (!state) return state.fault();
  if (state->state == "dark") {
    if (!lift) return latched(host_port_, *state);
    if (Status lifted = client->go(); !lifted) return lifted;
  }
  client_ = std::move(*client);
  return {};
}

Status ProtocolTrialRig::prepare(const ReadyCondition& condition, const std::stop_token& stop) {
  // The push takes the rig: only then may its light be ended.
  if (Status pushed = client_->push(condition.show, false, {}, stop); !pushed) return pushed;
  const auto state = client_->state();
  if (!state) return state.fault();
  if (state->state == "dark") return latched(host_port_, *state);
  if (state->state != "ready" && state->state != "empty") {
    if (Status ended = client_->blackout(); !ended) return ended;
    if (Status lifted = client_->go(); !lifted) return lifted;
  }
  if (Status active = client_->push(condition.show, true, {}, stop); !active) return active;
  sha256_ = condition.sha256;
  resting_ = condition.targets.front();
  shown_.reset();
  last_held_ = Clock::now();
  return check();
}

Status ProtocolTrialRig::show(const ShownTarget& target) {
  // First the cue: the first light is already this target's.
  if (Status cued = client_->cue(target.cue); !cued) return cued;
  if (Status lit = client_->hold(); !lit) return lit;
  shown_ = target;
  last_held_ = Clock::now();
  return check();
}

Status ProtocolTrialRig::dark() {
  if (!client_ || !shown_) return {};
  shown_.reset();
  const auto state = client_->state();
  if (!state) return state.fault();
  if (state->state == "dark") return latched(host_port_, *state);
  if (Status ended = client_->blackout(); !ended) return ended;
  return client_->go();
}

Status ProtocolTrialRig::check() {
  if (Status ours = stay_ours(); !ours) return ours;
  const auto state = client_->state();
  if (!state) return state.fault();
  return expect(*state, sha256_, shown_, host_port_);
}

/// A cue to what is shown already changes nothing, and makes no light where there is none.
Status ProtocolTrialRig::stay_ours() {
  if (Clock::now() - last_held_ < held_every) return {};
  last_held_ = Clock::now();
  return client_->cue(shown_ ? shown_->cue : resting_.cue);
}

}  // namespace focalstage
