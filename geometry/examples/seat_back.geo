// SPDX-License-Identifier: GPL-3.0-or-later
// The frame of a seat back: two posts, two rails between them, all of square bar. Lengths in m.
// x points forward, y to the left, z up; the posts stand on z = 0.
DefineConstant[
  height = {0.60, Name "Frame/height"},
  width = {0.45, Name "Frame/width"},
  bar = {0.025, Name "Frame/bar"},
  low_rail = {0.08, Name "Frame/low_rail"},
  size = {0.025, Name "Divisions/size"}
];
// A grid of rectangles in the plane x = -bar / 2; those of the frame are meshed.
y[] = {-width / 2, -width / 2 + bar, width / 2 - bar, width / 2};
z[] = {0, low_rail, low_rail + bar, height - bar, height};
For k In {0:4}
  For j In {0:3}
    Point(100 + 10 * k + j) = {-bar / 2, y[j], z[k]};
  EndFor
EndFor
For k In {0:4}
  For j In {0:2}
    Line(200 + 10 * k + j) = {100 + 10 * k + j, 101 + 10 * k + j};
    Transfinite Curve {200 + 10 * k + j} = Ceil((y[j + 1] - y[j]) / size - 1e-6) + 1;
  EndFor
EndFor
For k In {0:3}
  For j In {0:3}
    Line(300 + 10 * k + j) = {100 + 10 * k + j, 110 + 10 * k + j};
    Transfinite Curve {300 + 10 * k + j} = Ceil((z[k + 1] - z[k]) / size - 1e-6) + 1;
  EndFor
EndFor
For k In {0:3}
  For j In {0:2}
    If(j != 1 || k == 1 || k == 3)
      Curve Loop(400 + 10 * k + j) = {200 + 10 * k + j, 301 + 10 * k + j, -(210 + 10 * k + j), -(300 + 10 * k + j)};
      Plane Surface(400 + 10 * k + j) = {400 + 10 * k + j};
      Transfinite Surface {400 + 10 * k + j};
      Recombine Surface {400 + 10 * k + j};
    EndIf
  EndFor
EndFor
right[] = {}; left[] = {}; rails[] = {}; feet[] = {}; head[] = {};
For k In {0:3}
  For j In {0:2}
    If(j != 1 || k == 1 || k == 3)
      v[] = Extrude {bar, 0, 0} { Surface{400 + 10 * k + j}; Layers{1}; Recombine; };
      If(j == 0)
        right[] += v[1];
      ElseIf(j == 2)
        left[] += v[1];
      Else
        rails[] += v[1];
      EndIf
      If(k == 0)
        feet[] += v[2];
      EndIf
      If(k == 3 && j == 1)
        head[] += v[4];
      EndIf
    EndIf
  EndFor
EndFor
Physical Volume("right_post") = {right[]};
Physical Volume("left_post") = {left[]};
Physical Volume("rails") = {rails[]};
Physical Surface("feet") = {feet[]};
Physical Surface("head_rail") = {head[]};
