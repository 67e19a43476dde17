// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "vectors.h"

#include <phasesketch/brush.h>

#include <functional>

namespace ps::brushes {

/// Unit vectors at right angles, as in a StrokeContext.
struct Frame {
  Double3 up, side, front;
};
/// The stroke's, turned about its up by `angle` in rad, from side to front.
Frame frameOf(const api::StrokeContext& context, double angle);
/// Half extents of the box around half lengths along the frame's three vectors, m.
Double3 extentOf(const Frame& frame, const Double3& half);

/// A place on the way of a stroke.
struct Section {
  Double3 centre;     ///< m
  Double3 direction;  ///< unit vector along the way; zero where the hand has not moved yet
  double pressure;    ///< 0 .. 1
};
/// Goes along the way so finely that points at a distance of `reach` m from it come at most half a spacing apart, in
/// bends too: between two samples it turns about them. A stroke that has only begun is one section without direction.
void alongWay(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, double reach,
              const std::function<void(const Section&)>& each);

}  // namespace ps::brushes
