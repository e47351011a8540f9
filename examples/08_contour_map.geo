{ Values of a function of two variables: the contour map of Fig. 3 of Pasko, Adzhiev, Sourin and Savchenko (1995).

  The corner is the intersection of two half-planes by the R-function (4). Its boundary has a sharp corner, every other
  contour line is smooth: this is what blending rests on.

  Shows:    a function of type G: several of its levels in one picture.
  Run:      yont examples/08_contour_map.geo -o map.png
            the same with --palette diverging for bands of colour between the lines
  Expected: lines with their values; the one of 0 bold along the two axes, those of negative values dashed }

r_alpha = 0;

gob_corner = x1 & x2;

gob_corner : G = [-6, -5, -4, -3, -2, -1, 0, 0.25, 0.5, 0.75, 1];

x1min = -2;  x1max = 2;
x2min = -2;  x2max = 2;
