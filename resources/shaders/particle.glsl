// SPDX-License-Identifier: Apache-2.0
// Particles are two texels of a buffer: (x, y, z, radius), (r, g, b in sRGB, kind or fraction).
uniform samplerBuffer particles;
uniform int firstParticle;
