// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/overlays/timeline_bar.hpp"

#include <algorithm>

namespace rodeira::nodes {
namespace {

// In the panels' units.
constexpr float kTimelineText = 17.0F;
constexpr float kTextLow = 34.0F;
constexpr float kNoteGap = 7.0F;        // around the text over the bar
constexpr float kInstruments = 260.0F;  // to the right of it
constexpr float kKeysFrom = 860.0F;     // narrower pictures have no room for them

}  // namespace

double TimelinePlace::ShareAt(double x_px) const {
  const double margin = static_cast<double>(kMargin);
  return std::clamp(
      (x_px / static_cast<double>(scale) - margin) / std::max(1.0, static_cast<double>(width) - 2.0 * margin), 0.0,
      1.0);
}

TimelineBar::TimelineBar(osg::Group& overlay)
    : ground_(overlay, {0.04F, 0.05F, 0.07F, 0.62F}, 1),
      track_(overlay, {0.55F, 0.58F, 0.62F, 0.55F}, 2),
      done_(overlay, {0.36F, 0.66F, 0.93F, 1.0F}, 3),
      events_(overlay, {0.35F, 0.85F, 0.55F, 1.0F}, 4),
      marks_(overlay, {0.98F, 0.80F, 0.22F, 1.0F}, 4),
      knob_(overlay, {0.98F, 0.98F, 0.98F, 1.0F}, 5) {
  where_ = AddText(overlay, kTimelineText, osgText::TextBase::LEFT_BASE_LINE);
  note_ = AddText(overlay, 20.0F, osgText::TextBase::LEFT_BOTTOM);
  note_->setColor({0.98F, 0.80F, 0.22F, 1.0F});
  keys_ = AddText(overlay, kTimelineText, osgText::TextBase::RIGHT_BASE_LINE);
  keys_->setColor({0.75F, 0.78F, 0.82F, 1.0F});
}

void TimelineBar::Show(const std::optional<Timeline>& timeline, const PanelSize& size) {
  for (osgText::Text* text : {where_.get(), note_.get(), keys_.get()}) text->setNodeMask(timeline ? ~0U : 0U);
  if (!timeline) {
    for (Boxes* boxes : {&ground_, &track_, &done_, &events_, &marks_, &knob_}) boxes->Set({});
    return;
  }
  const TimelinePlace place(size);
  const float low = TimelinePlace::kTrackLow, high = TimelinePlace::kTrackHigh, now = place.XOf(timeline->share);
  track_.Set({{place.XOf(0.0), low, place.XOf(1.0), high}});
  done_.Set({{place.XOf(0.0), low, now, high}});
  const auto posts = [&](const std::vector<double>& shares, float beyond) {
    std::vector<Boxes::Box> boxes;
    for (const double share : shares)
      boxes.push_back({place.XOf(share) - 1.5F, low - beyond, place.XOf(share) + 1.5F, high + beyond});
    return boxes;
  };
  events_.Set(posts(timeline->events, 1.0F));
  marks_.Set(posts(timeline->marks, 4.0F));
  knob_.Set({{now - 4.0F, low - 5.0F, now + 4.0F, high + 5.0F}});
  where_->setText(timeline->where, osgText::String::ENCODING_UTF8);
  where_->setPosition({place.XOf(0.0), kTextLow, 0.0F});
  note_->setText(timeline->note, osgText::String::ENCODING_UTF8);
  note_->setMaximumWidth(std::max(200.0F, place.width - 2.0F * TimelinePlace::kMargin - kInstruments));
  note_->setPosition({place.XOf(0.0), TimelinePlace::kHeight + kNoteGap, 0.0F});
  std::vector<Boxes::Box> ground = {{0.0F, 0.0F, place.width, TimelinePlace::kHeight}};
  if (!timeline->note.empty()) {
    const osg::BoundingBox note = note_->getBoundingBox();
    ground.push_back({0.0F, TimelinePlace::kHeight, note.xMax() + TimelinePlace::kMargin, note.yMax() + kNoteGap});
  }
  ground_.Set(ground);
  keys_->setText(place.width >= kKeysFrom ? timeline->keys : "");
  keys_->setPosition({place.XOf(1.0), kTextLow, 0.0F});
}

}  // namespace rodeira::nodes
