#include <cuticle/bsdf/model_gpu.h>
