// Which channels a scene shadows alike (shadows::Channels). Before this: CHANNEL_CONSTANT, the number of the first of four
// specialisation constants (with_channels of pass_gpu.h).
layout(constant_id = CHANNEL_CONSTANT) const uint k_different = 1u;  // opacities
layout(constant_id = CHANNEL_CONSTANT + 1) const uint k_of_red = 0u;
layout(constant_id = CHANNEL_CONSTANT + 2) const uint k_of_green = 0u;
layout(constant_id = CHANNEL_CONSTANT + 3) const uint k_of_blue = 0u;
