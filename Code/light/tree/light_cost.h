// What a group of lights costs the choice among them: intensity times the directions that it lights
// (Conty Estevez and Kulla 2018).
#pragma once

// The measure of directions of normals within an angle of cosine cosSpread of an axis that shine up
// to an angle of cosine cosReach: 2 pi (1 - cos o) + pi/2 (2 w sin o - cos(o - 2 w) - 2 o sin o +
// cos o), w = min(o + e, pi). For cosReach 0, most lights, from a table: off by 1e-3 of it.
double directionsOf(double cosSpread, double cosReach);
