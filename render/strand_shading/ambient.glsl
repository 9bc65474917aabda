// The share of light that arrives at a strand after many scatterings, per unit of the frame's `multiple`.
vec3 multiple_scattering_share(float cos_i, vec3 transmittance) { return 0.7 * cos_i * sqrt(transmittance) + 0.3 * transmittance + 0.06; }
