{ A projection: Fig. 5b of Pasko, Adzhiev, Sourin and Savchenko (1995).

  The projection of an object is the union of all its sections across one coordinate: its shadow, when the light falls along it. Here three
  tori, one about each axis, throw theirs on the floor.

  Shows:    tr_project; the library's tori; several objects in one picture, each with a colour of its own.
  Run:      yont examples/24_projection.geo -o projection.png --object gob_tori,gob_shadow
            yont measure examples/24_projection.geo --object gob_tori
  Expected: the shadow is a ring that two bars cross; the tori are one body with seven tunnels, volume = 4.27 and
            Euler characteristic -12 }

gob_tori = pob_torus_x([0, 0, 0], 1.3, 0.25) | pob_torus_y([0, 0, 0], 1.3, 0.25) | pob_torus_z([0, 0, 0], 1.3, 0.25);

{ A plane figure }
gob_fig5b = tr_project(gob_tori, x3, -1.6, 1.6);

gob_shadow = gob_fig5b & (x3 + 2.3 & -2.2 - x3);

gob_tori   : COLOR = [0.95, 0.6, 0.2];
gob_shadow : COLOR = [0.35, 0.4, 0.5];

x1min = -1.7;  x1max = 1.7;  x2min = -1.7;  x2max = 1.7;  x3min = -2.4;  x3max = 1.7;
