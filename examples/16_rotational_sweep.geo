{ A solid of revolution: Fig. 5c of Pasko, Adzhiev, Sourin and Savchenko (1995).

  A plane profile (its coordinates are x2 and x3) times a segment of x1 is a solid bar. Then x1 is taken as the angle and
  x2 as the distance from an axis, and the bar is bent into a ring: Cartesian product and bijective mapping.

  Shows:    @; the mapping from cylindrical coordinates (10); an object of two coordinates inside one of three.
  Run:      yont examples/16_rotational_sweep.geo -o wheel.png
            yont measure examples/16_rotational_sweep.geo
            the same with --object gob_profile --at x1=0 --bounds x2=0:6 -o profile.png
  Expected: a wheel of which a quarter is missing. Pappus: the volume is that of the first moments of the
            profile's parts, 3.6 + 4.092 + 12.61 - 2.0975, times the angle 3/2 pi, so volume = 85.787 }

{ A plane rectangle between the corners (a, b) and (c, d) }
pob_rect(a, b, c, d) = (x2-a & c-x2) & (x3-b & d-x3);

{ Hub, web and rim, and a groove for the belt }
gob_groove  = 0.8**2 - (x2 - 5.9)**2 - x3**2;
gob_profile = (pob_rect(1, -1.2, 2, 1.2) | pob_rect(1, -0.3, 5, 0.3) | pob_rect(4.2, -1, 5.5, 1)) \ gob_groove;

{ The angle, from -3/4 pi to 3/4 pi }
gob_segment = x1 + 0.75*PI & 0.75*PI - x1;

gob_bar   = gob_profile @ gob_segment;
gob_wheel = gob_bar AT (x1 = ATAN2(x1 + x2, x2 - x1), x2 = HYPOT(x1, x2));

x1min = -5.8;  x1max = 5.8;
x2min = -5.8;  x2max = 5.8;
x3min = -1.5;  x3max = 1.5;
