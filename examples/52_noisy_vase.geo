{ The noisy vase: Fig. 12a of Pasko, Adzhiev, Sourin and Savchenko (1995).

  A vase of blended ellipsoids, and a part of the way from it to a solid noise: the metamorphosis leaves the vase irregular, as if it
  had been beaten by hand.

  Shows:    blending union; metamorphosis with solid noise; hollowing by an offset.
  Run:      yont examples/52_noisy_vase.geo -o vase.png
            the same with -D share=0 -o smooth.png
            yont measure examples/52_noisy_vase.geo -D share=0 --resolution 96
  Expected: a vase with dents and lumps; without noise it is smooth, and a cup: Euler characteristic 2 }

share = 0.033 IN [0, 0.2];

{ An ellipsoid about the axis at the height h, as wide as r and as high as e to each side; its values are about lengths }
pob_bulb(h, r, e) = MIN(r, e)*(1 - HYPOT(HYPOT(x1, x2)/r, (x3 - h)/e));

gob_belly = tr_bl_uni(pob_bulb(1, 1.1, 0.95), pob_bulb(2.2, 0.42, 1), 0.08, 0.3, 0.3);
gob_lip   = tr_bl_uni(gob_belly, pob_bulb(3.1, 0.85, 0.45), 0.1, 0.3, 0.3);
gob_body  = tr_bl_uni(gob_lip, pob_bulb(0, 0.75, 0.25), 0.08, 0.25, 0.25);

{ Level below, open above, hollow }
gob_vase  = (gob_body & 3.1 - x3 & x3) \ (tr_offset(gob_body, -0.24) & x3 - 0.2);
gob_noisy = tr_metamorphosis(gob_vase, pob_noise(0.8, 8, 1.4), share);

gob_noisy : COLOR = [0.75, 0.46, 0.33];

x1min = -1.5;  x1max = 1.5;  x2min = -1.5;  x2max = 1.5;  x3min = -0.2;  x3max = 3.3;
