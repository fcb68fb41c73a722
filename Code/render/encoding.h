// What a file of the picture is to be, as far as the settings say.
#pragma once

#include "image/image.h"
#include "render/settings.h"

// Pictures of one sample per pixel are drafts: they are made in milliseconds, and a file as small
// as can be would take up to a third longer to write.
inline Encoding encodingOf(const RenderSettings& settings, int bits) {
    const bool isSrgb = settings.picture.transfer == SettingsDesc::Transfer::Srgb;
    return {isSrgb ? Encoding::Transfer::Srgb : Encoding::Transfer::Linear, bits,
            settings.picture.samplesPerPixel == 1};
}
