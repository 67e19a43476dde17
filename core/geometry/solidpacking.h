// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/geometry/solidsurface.h"

#include <vector>

namespace ps {

/// Moves places in a solid until they lie as evenly as they can, and half a spacing or more from its surface: down the
/// slope of their concentration (Lind, Xu, Stansby & Rogers 2012, "Incompressible smoothed particle hydrodynamics for
/// free-surface flows", eq. 22), which is the packing of Colagrossi, Bouscasse, Antuono & Marrone 2012 ("Particle
/// packing algorithm for SPH schemes") where friction is all. What lies beyond the surface counts as half of space, and
/// pushes back what would leave; the kernel is one that makes no pairs (Dehnen & Aly 2012). Along the solid's own axes,
/// m; each place stands for `volume` m3. Deeper than some layers the lattice stays.
///
/// The same for any number of threads, and bounded: a hundred rounds, or fewer, a dozen at least, where there are many.
/// Error: they lie as liquids do, in disorder, which a density sum over two spacings takes for 1 to 2 % more than the
/// same matter on a lattice (see Solver::settle()). Tells its steps to the thread's Progress.
std::vector<Vector3> packSolid(const SolidSurface& surface, std::vector<Vector3> places, double volume);

}  // namespace ps
