// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "borrowed.h"
#include "vectors.h"

#include <phasesketch/brush.h>

namespace ps::brushes {

/// Unit vectors at right angles, as in a StrokeContext.
struct Frame {
  Double3 up, side, front;
};
/// The stroke's, turned about its up by `angle` in rad, from side to front.
Frame frameOf(const api::StrokeContext& context, double angle);
/// A vector as it lies when the stroke's frame is tipped about its side by `tip`, up to front, and then turned about
/// its up as in frameOf(); both in rad.
Double3 alongFrame(const api::StrokeContext& context, const Double3& v, double tip, double angle);
/// What a brush follows of a turn of the pen or the hand (api::StrokeSample::turn), by the value of kFollowing: none of
/// it, its part about the stroke's up, all of it.
Double3 following(const Double3& turn, const Double3& up, double how);
/// Turned about an axis by its length in rad.
Double3 turned(const Double3& v, const Double3& turn);
/// A frame as it is held, where it follows so.
Frame held(const Frame& frame, const Double3& turn, double how);
/// Half extents of the box around half lengths along the frame's three vectors, m.
Double3 extentOf(const Frame& frame, const Double3& half);

/// A place on the way of a stroke.
struct Section {
  Double3 centre;     ///< m
  Double3 direction;  ///< unit vector along the way; zero where the hand has not moved yet
  double pressure;    ///< 0 .. 1
  Double3 turn;       ///< as in api::StrokeSample
};
/// Goes along the way so finely that points at a distance of `reach` m from it come at most half a spacing apart, in
/// bends too: between two samples it turns about them. A stroke that has only begun is one section without direction.
void alongWay(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, double reach,
              const Borrowed<void(const Section&)>& each);

}  // namespace ps::brushes
