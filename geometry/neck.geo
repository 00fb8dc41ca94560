// SPDX-License-Identifier: GPL-3.0-or-later
//
// The neck of the Hybrid III manikin: five aluminium plates, four rubber sections and the hole for
// the cable, as structured blocks of hexahedra. Lengths in m.
//
// Frame: x forward, y left, z from base to head; the origin lies on the plate axis at the base
// face. Layers from below: base plate, rubber 1, plate 1, rubber 2, plate 2, rubber 3, plate 3,
// rubber 4, top plate. Look at it with: gmsh neck.geo, then press 3.
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
  // Both rings: element length over that of the neighbour nearer to the rubber's rim.
  ring_grading = {1, Name "Divisions/ring_grading"},
  // Rubber: layer thickness at mid-height over that at the bonds.
  rubber_grading = {1, Name "Divisions/rubber_grading"}
];

rubber_height = (length - base_plate_thickness - 3 * plate_thickness - top_plate_thickness) / 4;

// Layer k = 0 … 8 lies between planes k and k + 1; even layers are plates.
// Each plane carries three circles, g = 0 … 2: hole, rubber, plate rim; they make two rings,
// g = 0, 1. Spokes at q * 90 + 45 degrees, seen from the plate axis, cut each ring in four. So the
// bolts at 45, 135, 225 and 315 degrees lie on spokes whatever the offset of the rubber is.
//
// Where the circles below and above a plate differ, the surface between the plate's two rings is
// ruled from one to the other; it is internal, so no volume depends on it.

height[] = {base_plate_thickness, rubber_height, plate_thickness, rubber_height, plate_thickness,
            rubber_height, plate_thickness, rubber_height, top_plate_thickness};
layers[] = {end_plate_layers, rubber_layers, plate_layers, rubber_layers, plate_layers,
            rubber_layers, plate_layers, rubber_layers, end_plate_layers};

// Circle of the rubber that is bonded to each plane; the free faces of the end plates repeat it.
b = bottom_rubber_diameter / 2;
c = centre_rubber_diameter / 2;
t = top_rubber_diameter / 2;
rubber_radius[] = {b, b, b, c, c, c, c, t, t, t};
b = bottom_rubber_offset;
c = centre_rubber_offset;
t = top_rubber_offset;
rubber_offset[] = {b, b, b, c, c, c, c, t, t, t};

// Tags: 1 + q + 4 g + 12 (plane or layer) within each family, families 200 apart.
arc = 200; spoke = 400; upright = 600;    // curves
face = 200; shell = 400; spoke_wall = 600;  // surfaces

// Points. Centres of the circles have q = 0 of their own family.
centre = 200;
z = 0;
For j In {0 : 9}
  For g In {0 : 2}
    tag = 1 + 4 * g + 12 * j;
    offset = 0;
    radius = hole_diameter / 2;
    If (g == 1)
      offset = rubber_offset[j];
      radius = rubber_radius[j];
    EndIf
    If (g == 2)
      radius = plate_diameter / 2;
    EndIf
    Point(centre + tag) = {offset, 0, z};
    For q In {0 : 3}
      // Distance from the axis, along the spoke, of a circle whose centre is shifted towards +x.
      ux = Cos(Pi / 4 + q * Pi / 2);
      uy = Sin(Pi / 4 + q * Pi / 2);
      reach = offset * ux + Sqrt(radius * radius - offset * offset * uy * uy);
      Point(tag + q) = {reach * ux, reach * uy, z};
    EndFor
  EndFor
  If (j < 9)
    z = z + height[j];
  EndIf
EndFor

// Curves and faces within the planes.
For j In {0 : 9}
  For g In {0 : 2}
    tag = 1 + 4 * g + 12 * j;
    For q In {0 : 3}
      next = (q + 1) % 4;
      Circle(arc + tag + q) = {tag + q, centre + tag, tag + next};
      Transfinite Curve {arc + tag + q} = quadrant + 1;
      If (g < 2)
        Line(spoke + tag + q) = {tag + q, tag + 4 + q};
        If (g == 0)
          Transfinite Curve {spoke + tag + q} = inner_ring + 1 Using Progression 1 / ring_grading;
        Else
          Transfinite Curve {spoke + tag + q} = outer_ring + 1 Using Progression ring_grading;
        EndIf
      EndIf
    EndFor
  EndFor
  For g In {0 : 1}
    tag = 1 + 4 * g + 12 * j;
    For q In {0 : 3}
      next = (q + 1) % 4;
      Curve Loop(face + tag + q) = {spoke + tag + q, arc + tag + 4 + q, -(spoke + tag + next),
                                    -(arc + tag + q)};
      Plane Surface(face + tag + q) = {face + tag + q};
    EndFor
  EndFor
EndFor

// Curves, walls and blocks between the planes. Rubber layers have the inner ring only.
For k In {0 : 8}
  is_plate = (k % 2 == 0);
  rings = is_plate ? 2 : 1;
  For g In {0 : rings}
    tag = 1 + 4 * g + 12 * k;
    For q In {0 : 3}
      Line(upright + tag + q) = {tag + q, tag + 12 + q};
      If (is_plate)
        Transfinite Curve {upright + tag + q} = layers[k] + 1;
      Else
        Transfinite Curve {upright + tag + q} = layers[k] + 1 Using Bump 1 / rubber_grading;
      EndIf
    EndFor
    For q In {0 : 3}
      next = (q + 1) % 4;
      Curve Loop(shell + tag + q) = {arc + tag + q, upright + tag + next, -(arc + tag + 12 + q),
                                     -(upright + tag + q)};
      Surface(shell + tag + q) = {shell + tag + q};
    EndFor
  EndFor
  For g In {0 : rings - 1}
    tag = 1 + 4 * g + 12 * k;
    For q In {0 : 3}
      Curve Loop(spoke_wall + tag + q) = {spoke + tag + q, upright + tag + 4 + q,
                                          -(spoke + tag + 12 + q), -(upright + tag + q)};
      Plane Surface(spoke_wall + tag + q) = {spoke_wall + tag + q};
    EndFor
    For q In {0 : 3}
      next = (q + 1) % 4;
      Surface Loop(tag + q) = {face + tag + q, face + tag + 12 + q, shell + tag + q,
                               shell + tag + 4 + q, spoke_wall + tag + q, spoke_wall + tag + next};
      Volume(tag + q) = {tag + q};
    EndFor
  EndFor
EndFor

Transfinite Surface {:};
Recombine Surface {:};
Transfinite Volume {:};

// Volume tags of layer k start at 1 + 12 k: four of the inner ring, then four of the outer one.
Physical Volume("base_plate") = {1 : 8};
Physical Volume("rubber_1") = {13 : 16};
Physical Volume("plate_1") = {25 : 32};
Physical Volume("rubber_2") = {37 : 40};
Physical Volume("plate_2") = {49 : 56};
Physical Volume("rubber_3") = {61 : 64};
Physical Volume("plate_3") = {73 : 80};
Physical Volume("rubber_4") = {85 : 88};
Physical Volume("top_plate") = {97 : 104};
Physical Surface("base") = {face + 1 : face + 8};
Physical Surface("top") = {face + 12 * 9 + 1 : face + 12 * 9 + 8};

// 27-node hexahedra; a reproducible 3-D algorithm, should a block ever not be structured.
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 0;
Mesh.Algorithm3D = 1;
