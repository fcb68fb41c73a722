// How an equirectangular picture is placed around the scene. Directions are Blender's: the middle
// of the picture is towards +x, its upper edge is +z, and the left quarter is towards +y.
#pragma once

struct SkyPlace {
    bool isZUp = true; // else +y is up, and the left quarter is towards -z
    double turns = 0;  // about the upward axis, +x towards the left quarter
};
