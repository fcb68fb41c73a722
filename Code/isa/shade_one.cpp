// One lane, for every machine: the instances of formulas that are the scalar code.
#include "camera/camera_in_lanes.h"
#include "denoise/denoise_in_lanes.h"
#include "integrate/shading_in_lanes.h"
#include "isa/instances.h"
#include "texture/pictures_in_lanes.h"

constexpr ShadingKernel kOneShading = kernels::one::kShading;
constexpr PictureLanes kOnePictures = kernels::one::kPictures;
constexpr CameraLanes kOneCamera = kernels::one::kCamera;
constexpr DenoiseLanes kOneDenoise = kernels::one::kDenoise;
