{ A furry object: Fig. 12b of Pasko, Adzhiev, Sourin and Savchenko (1995).

  Fur is the part of a layer around an object in which a solid noise is high: hairs that stand along the normals, since the noise is
  that at the foot of each point on the surface.

  Shows:    tr_fur; colours by a formula.
  Run:      yont examples/53_furry.geo -o furry.png
            yont measure examples/53_furry.geo --object gob_body
  Expected: a ring in a coat of fur; without it, volume = 5.922 and Euler characteristic 0 }

gob_body  = 0.5 - HYPOT(HYPOT(x1, x2) - 1.2, x3);
gob_furry = tr_fur(gob_body, 0.3, 70, -0.4);

{ Darker towards the skin }
depth = CLAMP(-gob_body/0.3, 0, 1);
gob_furry : COLOR = [0.35, 0.22, 0.12] + depth*[0.5, 0.38, 0.25];

x1min = -2.1; x1max = 2.1; x2min = -2.1; x2max = 2.1; x3min = -0.9; x3max = 0.9;
