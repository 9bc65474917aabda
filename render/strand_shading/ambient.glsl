// The share of light that arrives at a strand after many scatterings, per unit of the frame's `multiple`.
vec3 ambient_share(float cos_i, vec3 through) { return 0.7 * cos_i * sqrt(through) + 0.3 * through + 0.06; }
