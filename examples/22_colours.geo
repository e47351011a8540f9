{ Colours: several objects in one picture, cut open.

  A peach on a plate. A colour is a definition like others: the skin blushes where it faces the sun, the flesh reddens
  towards the stone (which a cut shows), and the plate takes its colour from the palette by the distance from its
  middle. What was named first stands before what lies in the same place.

  Shows:    COLOR as constants, as an expression of the coordinates and as a value of the palette; several objects,
            a cut with its sections, ambient occlusion.
  Run:      yont examples/22_colours.geo -o peach.png --object gob_stone,gob_peach,gob_stalk,gob_plate --cut x2=0
            the same with -o whole.png, --cut left out, for the whole peach
            yont measure examples/22_colours.geo --object gob_stone --resolution 96
  Expected: half a peach on a plate, hatched where it is cut, with its stone and stalk; the stone has the volume = 0.5301 }

{ Nearly the distance from an ellipsoid }
body = SQRT(x1**2 + x2**2 + 1.15*x3**2);

{ The furrow goes from pole to pole on the right }
furrow = 0.12*EXP(-14*(ATAN2(x2, x1))**2);
gob_stone = 1 - (x1/0.45)**2 - (x2/0.45)**2 - (x3/0.625)**2;
gob_peach = (1.2 - furrow - 0.25*EXP(-9*(x1**2 + x2**2))*(x3 > 0) - body) \ gob_stone;
gob_stalk = (0.06**2 - (x1 - 0.15*(x3 - 0.8)**2)**2 - x2**2) & (x3 - 0.8) & (1.5 - x3);

across = SQRT(x1**2 + x2**2);
gob_plate = 0.09 - ABS(x3 + 1.2 - 0.08*across**2) & 2.3 - across;

{ 0 in the middle, 1 at the skin }
depth = body/1.2;
blush = 0.5 + 0.5*TANH(3*(x3 - 0.6*x1));

gob_peach : COLOR = IF depth > 0.93 THEN [0.95, 0.35 + 0.35*(1 - blush), 0.2] ELSE [1, 0.35 + 0.5*depth, 0.25 + 0.2*depth];
gob_stone : COLOR = [0.45, 0.25, 0.12];
gob_stalk : COLOR = [0.35, 0.45, 0.15];
gob_plate : COLOR = across IN [0, 2.5];

palette = "viridis";
occlusion = 1;
camera = [-25, 28];
