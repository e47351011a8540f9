{ A slider cannot step backwards. }
r1 = 4. IN [1., 8.] STEP -0.5;
