// The instances that the units of this folder define, for choose.cpp.
#pragma once

#include "isa/isa.h"

extern const Isa kSseIsa, kAvx2Isa, kAvx512Isa;
extern const ShadingKernel kOneShading, kSseShading, kAvx2Shading, kAvx512Shading;
extern const PictureLanes kOnePictures;
extern const CameraLanes kOneCamera;
extern const DenoiseLanes kOneDenoise;
