// SPDX-License-Identifier: GPL-3.0-or-later
//
// The neck of the Hybrid III manikin: five aluminium plates, four rubber sections and the hole for
// the cable, as structured blocks of hexahedra. Lengths in m.
//
// Frame: x forward, y left, z from base to head; the origin lies on the plate axis at the base
// face. Layers from below: base plate, rubber 1, plate 1, rubber 2, plate 2, rubber 3, plate 3,
// rubber 4, top plate. Look at it with: gmsh neck.geo, then press 3.
// Surfaces: "base", "top" and, where asked for, "slit_rubber_1" … "slit_rubber_4".
//
// Every constant below can be overridden from outside; the values here are those of the default
// neck (parameter file hybrid3_c.toml), with their origin: published in the paper of Ashrafiuon
// et al., inferred from it, or calibrated (fitted to published results).

SetFactory("Built-in");
inch = 0.0254;

DefineConstant[
  // published: 5.66 in, end plates included
  length = {5.66 * inch, Name "Neck/length"},
  // calibrated
  base_plate_thickness = {1.357 * inch, Name "Neck/base_plate_thickness"},
  // calibrated, equal for the three intermediate plates
  plate_thickness = {0.326 * inch, Name "Neck/plate_thickness"},
  // calibrated
  top_plate_thickness = {0.306 * inch, Name "Neck/top_plate_thickness"},
  // published: 3.4 in for the intermediate plates; inferred for the end plates
  plate_diameter = {3.4 * inch, Name "Neck/plate_diameter"},
  // published: 0.625 in; inferred: centred on the plate axis, through all nine layers
  hole_diameter = {0.625 * inch, Name "Neck/hole_diameter"},
  // published: 2.7 in for the two centre sections
  centre_rubber_diameter = {2.7 * inch, Name "Neck/centre_rubber_diameter"},
  // published: 0.2 in towards the front
  centre_rubber_offset = {0.2 * inch, Name "Neck/centre_rubber_offset"},
  // calibrated
  bottom_rubber_diameter = {2.038 * inch, Name "Neck/bottom_rubber_diameter"},
  // calibrated
  bottom_rubber_offset = {0.351 * inch, Name "Neck/bottom_rubber_offset"},
  // calibrated
  top_rubber_diameter = {2.266 * inch, Name "Neck/top_rubber_diameter"},
  // calibrated
  top_rubber_offset = {0.4 * inch, Name "Neck/top_rubber_offset"},

  // Divisions of the blocks.
  quadrant = {4, Name "Divisions/quadrant"},
  inner_ring = {3, Name "Divisions/inner_ring"},
  outer_ring = {1, Name "Divisions/outer_ring"},
  rubber_layers = {3, Name "Divisions/rubber_layers"},
  plate_layers = {1, Name "Divisions/plate_layers"},
  end_plate_layers = {1, Name "Divisions/end_plate_layers"},
  // Element length over that of the neighbour nearer to the rubber's rim, on either side of it.
  ring_grading = {1.15, Name "Divisions/ring_grading"},
  // Rubber: thickness of a layer over that of the neighbour nearer to the bond.
  rubber_grading = {1.5, Name "Divisions/rubber_grading"},
  // Every element is cut in so many in each direction, its neighbours' ratio spread over them.
  refine = {1, Name "Divisions/refine"},
  // 1: hexahedra. 0: tetrahedra in the same blocks, with twice the divisions round the neck and
  // through its plates: cut into the hexahedra of the default, they would be too flat.
  recombine = {1, Name "Divisions/recombine"},

  // Share of the rubber between its front rim and the hole that a slit cuts through; 0 without slits.
  // The paper gives the centre sections slits; where and how deep is inferred.
  slit_depth = {0, Name "Slits/slit_depth"},
  // 1: the section gets the surface of a slit at mid-height, "slit_rubber_<n>".
  slit_rubber_1 = {0, Name "Slits/slit_rubber_1"},
  slit_rubber_2 = {0, Name "Slits/slit_rubber_2"},
  slit_rubber_3 = {0, Name "Slits/slit_rubber_3"},
  slit_rubber_4 = {0, Name "Slits/slit_rubber_4"}
];

rubber_height = (length - base_plate_thickness - 3 * plate_thickness - top_plate_thickness) / 4;

// Each plane carries the circles g = 0 … rings: hole (0), rubber (inner_ring), plate rim (rings).
// The circles between change centre and radius evenly, so that every ring of elements lies between
// true arcs. Spokes at q * 90 + 45 degrees, seen from the plate axis, cut each ring in four: the
// bolts at 45, 135, 225 and 315 degrees lie on spokes whatever the offset of the rubber is. A neck
// with a slit depth has spokes at 0, 90, 180 and 270 degrees as well, and circle `slit_ring` moved
// to that depth: between them lie the slits, from -90 to 90 degrees.
//
// Where the circles below and above a plate differ, the shells between its rings are ruled from one
// to the other; they are internal, so no volume depends on them.

rings = inner_ring + outer_ring;
sectors = (slit_depth > 0) ? 8 : 4;
arc_divisions = quadrant * 4 / sectors * refine * (recombine ? 1 : 2);
slit[] = {slit_rubber_1, slit_rubber_2, slit_rubber_3, slit_rubber_4};

// Level k lies between planes k and k + 1: a whole plate, or one layer of elements of a rubber
// section. Sections n = 0 … 8 from below: even ones are plates.
thickness[] = {base_plate_thickness, rubber_height, plate_thickness, rubber_height,
               plate_thickness, rubber_height, plate_thickness, rubber_height,
               top_plate_thickness};
plate_divisions[] = {end_plate_layers, 0, plate_layers, 0, plate_layers, 0, plate_layers, 0,
                     end_plate_layers};
// The rubber circle at the lower face of each section. Through a plate it turns into the one at its
// upper face; the free faces of the end plates have the circle of the bonded ones.
b = bottom_rubber_diameter / 2;
c = centre_rubber_diameter / 2;
t = top_rubber_diameter / 2;
section_radius[] = {b, b, b, c, c, c, c, t, t};
b = bottom_rubber_offset;
c = centre_rubber_offset;
t = top_rubber_offset;
section_offset[] = {b, b, b, c, c, c, c, t, t};

// Layers of a rubber section grow from both bonds to mid-height.
layer_share[] = {};
layer_ratio[] = {};
sum = 0;
For i In {0 : rubber_layers - 1}
  from_bond = (2 * i < rubber_layers) ? i : rubber_layers - 1 - i;
  layer_share[i] = rubber_grading ^ from_bond;
  sum = sum + layer_share[i];
  side = (2 * i + 1 < rubber_layers) ? 1 : (2 * i + 1 > rubber_layers) ? -1 : 0;
  layer_ratio[i] = rubber_grading ^ (side / refine);
EndFor

levels = 0;
level_section[] = {};
level_height[] = {};
level_ratio[] = {};
mid_plane[] = {};
For n In {0 : 8}
  parts = (n % 2 == 0) ? 1 : rubber_layers;
  mid_plane[n] = levels + parts / 2;
  For i In {0 : parts - 1}
    level_section[levels] = n;
    level_ratio[levels] = (n % 2 == 0) ? 1 : layer_ratio[i];
    level_height[levels] = (n % 2 == 0) ? thickness[n] : thickness[n] * layer_share[i] / sum;
    levels = levels + 1;
  EndFor
EndFor

// Way from the hole's circle (0) to the rubber's (1), and on to the rim's (2), of each circle.
way[] = {0};
sum = 0;
For g In {1 : inner_ring}
  sum = sum + ring_grading ^ (-g);
  way[g] = sum;
EndFor
For g In {1 : inner_ring}
  way[g] = way[g] / sum;
EndFor
sum = 0;
For g In {1 : outer_ring}
  sum = sum + ring_grading ^ g;
  way[inner_ring + g] = sum;
EndFor
For g In {1 : outer_ring}
  way[inner_ring + g] = 1 + way[inner_ring + g] / sum;
EndFor

// The circle nearest to the depth of the slits moves there; those on either side follow in
// proportion.
slit_ring = 0;
If (slit_depth > 0)
  If (inner_ring < 2 || slit_depth >= 1)
    Error("slits need slit_depth < 1 and inner_ring of at least 2");
  EndIf
  edge = 1 - slit_depth;
  slit_ring = 1;
  For g In {1 : inner_ring - 1}
    If (Fabs(way[g] - edge) < Fabs(way[slit_ring] - edge))
      slit_ring = g;
    EndIf
  EndFor
  old_edge = way[slit_ring];
  For g In {1 : inner_ring - 1}
    way[g] = (g <= slit_ring) ? way[g] * edge / old_edge
                              : 1 - (1 - way[g]) * slit_depth / (1 - old_edge);
  EndFor
EndIf

// Tags: 1 + q + sectors * g + step * (plane or level) within each family, families one `family` apart.
step = sectors * (rings + 1);
family = (levels + 1) * step;
arc = family; spoke = 2 * family; upright = 3 * family;    // curves
face = family; shell = 2 * family; wall = 3 * family;      // surfaces

// Points. The centre of a circle has the tag of the circle's first arc. Planes inside a rubber
// section end at the rubber's circle: plane_rings counts the rings of elements that they cut.
plane_rings[] = {};
z = 0;
For j In {0 : levels}
  below = level_section[(j == 0) ? 0 : j - 1];
  above = level_section[(j == levels) ? levels - 1 : j];
  plane_rings[j] = (below % 2 == 0 || above % 2 == 0) ? rings : inner_ring;
  For g In {0 : plane_rings[j]}
    tag = 1 + sectors * g + step * j;
    s = way[g];
    If (s <= 1)
      offset = s * section_offset[above];
      radius = (1 - s) * hole_diameter / 2 + s * section_radius[above];
    Else
      offset = (2 - s) * section_offset[above];
      radius = (2 - s) * section_radius[above] + (s - 1) * plate_diameter / 2;
    EndIf
    Point(arc + tag) = {offset, 0, z};
    For q In {0 : sectors - 1}
      // Distance from the axis, along the spoke, of a circle whose centre is shifted towards +x.
      ux = Cos(Pi / 4 + q * 2 * Pi / sectors);
      uy = Sin(Pi / 4 + q * 2 * Pi / sectors);
      reach = offset * ux + Sqrt(radius * radius - offset * offset * uy * uy);
      Point(tag + q) = {reach * ux, reach * uy, z};
    EndFor
  EndFor
  If (j < levels)
    z = z + level_height[j];
  EndIf
EndFor

// Curves and faces within the planes.
For j In {0 : levels}
  For g In {0 : plane_rings[j]}
    tag = 1 + sectors * g + step * j;
    ratio = ring_grading ^ ((g < inner_ring ? -1 : 1) / refine);
    For q In {0 : sectors - 1}
      Circle(arc + tag + q) = {tag + q, arc + tag, tag + (q + 1) % sectors};
      Transfinite Curve {arc + tag + q} = arc_divisions + 1;
      If (g < plane_rings[j])
        Line(spoke + tag + q) = {tag + q, tag + sectors + q};
        Transfinite Curve {spoke + tag + q} = refine + 1 Using Progression ratio;
      EndIf
    EndFor
  EndFor
  For g In {0 : plane_rings[j] - 1}
    tag = 1 + sectors * g + step * j;
    For q In {0 : sectors - 1}
      Curve Loop(face + tag + q) = {spoke + tag + q, arc + tag + sectors + q,
                                    -(spoke + tag + (q + 1) % sectors), -(arc + tag + q)};
      Plane Surface(face + tag + q) = {face + tag + q};
    EndFor
  EndFor
EndFor

// Curves, walls and blocks between the planes.
For k In {0 : levels - 1}
  n = level_section[k];
  level_rings = (n % 2 == 0) ? rings : inner_ring;
  divisions = refine * ((n % 2 == 0) ? plate_divisions[n] * (recombine ? 1 : 2) : 1);
  For g In {0 : level_rings}
    tag = 1 + sectors * g + step * k;
    For q In {0 : sectors - 1}
      Line(upright + tag + q) = {tag + q, tag + step + q};
      Transfinite Curve {upright + tag + q} = divisions + 1 Using Progression level_ratio[k];
    EndFor
    For q In {0 : sectors - 1}
      Curve Loop(shell + tag + q) = {arc + tag + q, upright + tag + (q + 1) % sectors,
                                     -(arc + tag + step + q), -(upright + tag + q)};
      Surface(shell + tag + q) = {shell + tag + q};
    EndFor
  EndFor
  For g In {0 : level_rings - 1}
    tag = 1 + sectors * g + step * k;
    For q In {0 : sectors - 1}
      Curve Loop(wall + tag + q) = {spoke + tag + q, upright + tag + sectors + q,
                                    -(spoke + tag + step + q), -(upright + tag + q)};
      Plane Surface(wall + tag + q) = {wall + tag + q};
    EndFor
    For q In {0 : sectors - 1}
      Surface Loop(tag + q) = {face + tag + q, face + tag + step + q, shell + tag + q,
                               shell + tag + sectors + q, wall + tag + q, wall + tag + (q + 1) % sectors};
      Volume(tag + q) = {tag + q};
    EndFor
  EndFor
EndFor

Transfinite Surface {:};
If (recombine)
  Recombine Surface {:};
EndIf
Transfinite Volume {:};

// The blocks of a level follow one another, ring by ring.
For n In {0 : 8}
  blocks[] = {};
  For k In {0 : levels - 1}
    If (level_section[k] == n)
      level_rings = (n % 2 == 0) ? rings : inner_ring;
      blocks[] += {1 + k * step : sectors * level_rings + k * step};
    EndIf
  EndFor
  If (n == 0)
    Physical Volume("base_plate") = blocks[];
  ElseIf (n == 8)
    Physical Volume("top_plate") = blocks[];
  ElseIf (n % 2 == 0)
    Physical Volume(Sprintf("plate_%g", n / 2)) = blocks[];
  Else
    Physical Volume(Sprintf("rubber_%g", (n + 1) / 2)) = blocks[];
  EndIf
EndFor
Physical Surface("base") = {face + 1 : face + sectors * rings};
Physical Surface("top") = {face + 1 + levels * step : face + sectors * rings + levels * step};

// Slits run from circle slit_ring to the rim, through the sectors 0 and 5 to 7 of 45 degrees each:
// the front half.
For n In {1 : 4}
  If (slit[n - 1])
    If (slit_depth <= 0 || rubber_layers % 2 != 0)
      Error("slits need slit_depth > 0 and an even number of rubber_layers");
    EndIf
    cut[] = {};
    For g In {slit_ring : inner_ring - 1}
      tag = 1 + sectors * g + step * mid_plane[2 * n - 1];
      cut[] += {face + tag, face + tag + 5, face + tag + 6, face + tag + 7};
    EndFor
    Physical Surface(Sprintf("slit_rubber_%g", n)) = cut[];
  EndIf
EndFor

// 27-node hexahedra; a reproducible 3-D algorithm, should a block ever not be structured.
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 0;
Mesh.Algorithm3D = 1;
