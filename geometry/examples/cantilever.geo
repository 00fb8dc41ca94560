// SPDX-License-Identifier: GPL-3.0-or-later
// A straight bar, clamped at one end: hexahedra. Lengths in m.
DefineConstant[
  length = {0.5, Name "Bar/length"},
  width = {0.03, Name "Bar/width"},
  height = {0.02, Name "Bar/height"},
  along = {12, Name "Divisions/along"},
  across = {1, Name "Divisions/across"}
];
Point(1) = {0, -width / 2, -height / 2};
Point(2) = {0, width / 2, -height / 2};
Line(1) = {1, 2};
Transfinite Curve {1} = across + 1;
section[] = Extrude {0, 0, height} { Line{1}; Layers{across}; Recombine; };
bar[] = Extrude {length, 0, 0} { Surface{section[1]}; Layers{along}; Recombine; };
Physical Volume("bar") = {bar[1]};
Physical Surface("clamp") = {section[1]};
Physical Surface("tip") = {bar[0]};
