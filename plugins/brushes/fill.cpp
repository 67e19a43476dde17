// SPDX-License-Identifier: Apache-2.0
#include "fill.h"

#include "frame.h"
#include "stamping.h"

#include <string_view>
#include <vector>

FillBrush::FillBrush()
    : Described(
          {"Fill",
           "Lets a hollow run full, up to where you point: all free places that are reached from there and lie no "
           "higher. Point at the inside of its wall to fill it further. It goes by the matter as it was when the "
           "stroke began, and refuses what would run out over a rim or through a gap. Ctrl erases.",
           {}}) {}

void FillBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                       const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  using namespace ps::brushes;
  std::vector<ps::api::Cell>& cells = roomForCells();
  alongWay(context, samples, 0, [&](const Section& section) { cells.push_back(cellAt(context, section.centre)); });
  sink.submit(kind == ps::api::EditKind::Remove ? kind : ps::api::EditKind::Fill, {cells.data(), cells.size()});
}

ps::api::Double3 FillBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  const double half = context.spacing / 2;
  return {half, half, half};
}

const void* FillBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kFillsHollows ? this : nullptr;
}
