// What a file of the picture is to be, as far as the settings say.
#pragma once

#include "image/image.h"
#include "render/settings.h"

// Pictures of one sample per pixel are drafts: they are made in milliseconds, of which writing a
// file as small as can be takes up to a sixth.
inline Encoding encodingOf(const RenderSettings& settings, int bits) {
    const bool isSrgb = settings.picture.transfer == SettingsDesc::Transfer::Srgb;
    return {isSrgb ? Encoding::Transfer::Srgb : Encoding::Transfer::Linear, bits,
            settings.picture.samplesPerPixel == 1};
}
