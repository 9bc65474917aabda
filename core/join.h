#pragma once
// One name of two, after macros in them have been replaced.

#define CUTICLE_JOIN_NAMES(a, b) a##b
#define CUTICLE_JOIN(a, b) CUTICLE_JOIN_NAMES(a, b)
