// Three marbles, a clay block, a saucer and a small paper tent on a tiled floor, under one lamp.

#version 3.7;

#include "paints.inc"
#include "tent.inc"

global_settings {
  assumed_gamma 1
  max_trace_level 5
}

camera {
  location <0, 1.2, -4>
  angle 40
  right x
  look_at <0, 0.4, 0>
}

light_source {
  <1, 3, -1>
  color rgb 1
}

#declare Tiles = pigment {
  image_map { png "tiles.png" interpolate 2 }
  rotate 90*x
}

plane {
  y, 0
  pigment { Tiles }
  normal { bumps 0.1 }
  finish { diffuse 0.8 }
}

box {
  <-1.6, 0, 0.4>, <-1, 0.5, 1>
  texture { Clay }
}

disc {
  <0.9, 0.001, 0.5>, y, 0.25
  pigment { rgb 0.5 }
}

object {
  Tent
  texture { Paper }
  translate <0, 0, 0.6>
}

#macro Marble(X, Z, Radius, Stuff)
  sphere {
    <X, Radius, Z>, Radius
    texture { Stuff }
    interior { ior 1.5 }
  }
#end

Marble(0.7, -0.5, 0.4, Crystal)
Marble(-0.8, -0.4, 0.3, Clay)
Marble(0.2, -0.9, 0.12, Clay)
