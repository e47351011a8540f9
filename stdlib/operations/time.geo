// Metamorphosis and time

{ From g1 to g2: g goes from 0 to 1, as a function of time or of any coordinate.
  Example: tr_metamorphosis(pob_sphere([0, 0, 0], 1), pob_box([0, 0, 0], [1.6, 1.6, 1.6]), 0.5) AT (0, 0, 0) > 0   // 1
  Source: [P95] (15) }
tr_metamorphosis((gob/pob) g1, (gob/pob) g2, (real) g) = g1*(1 - g) + g2*g;

{ A metamorphosis of any number of objects over time x4: list[k] at times[k], which rise; before the first and after the last nothing changes.
  Example: tr_metamorphosis_n([pob_sphere([0, 0, 0], 1), x1, 5*x1], [0, 1, 3]) AT (1, 0, 0, 2)   // 3
  Source: [P95] (15) }
tr_metamorphosis_n((array) list, (array) times) =
  list[1] + SUM(k = 1 TO LEN(list) - 1, (list[k + 1] - list[k])*CLAMP((x4 - times[k])/(times[k + 1] - times[k]), 0, 1));

{ From g1 to g2 by a blend in space and time: a bounded blend of g1 at x4 <= 0 and g2 at x4 >= 1, while x4 goes from -10 to 10. It works where both
  objects lie apart. a0, a1, a2, a3 are those of tr_bl_bounded.
  Example: tr_space_time_blend(pob_circle([-1, 0], 0.5), pob_circle([1, 0], 0.5), 5, 1, 1, 1) AT (-1, 0, 0, -10) > 0   // 1
  Source: Pasko, Pasko, Kunii 2004 }
tr_space_time_blend((gob/pob) g1, (gob/pob) g2, (real) a0, (real) a1, (real) a2, (real) a3) =
  tr_bl_bounded(g1 & -x4, g2 & x4 - 1, a0, a1, a2, x4 + 10 & 10 - x4, a3);

{ The object as it is there from the time t1 to t2 only; time is x4.
  Example: tr_time_segment(pob_sphere([0, 0, 0], 1), -1, 1) AT (0, 0, 0, 1)   // 0
  Source: [P95] (14) }
tr_time_segment((gob/pob) g, (real) t1, (real) t2) = g @ (x4 - t1 & t2 - x4);

{ The object at the place path(t): with t = x4 it moves in time.
  Example: tr_move(pob_sphere([0, 0, 0], 0.5), fn_circle_path, x4) AT (0, 1, 0.5, PI/2)   // 0
  Source: [P95] 2.2.5 }
tr_move((gob/pob) g, (function) path, (real) t) = g AT (fn_from(path(t)));

{ The object later by the time d; time is x4.
  Example: tr_delay(x4, 3) AT (0, 0, 0, 5)   // 2
  Source: [P95] 2.2.5 }
tr_delay((gob/pob) g, (real) d) = g AT (x4 = x4 - d);

{ The object at the time t instead of x4: 2*x4 is twice as fast, -x4 backwards.
  Example: tr_time_map(x4, 10 - x4) AT (0, 0, 0, 2)   // 8
  Source: [P95] 2.2.5 }
tr_time_map((gob/pob) g, (real) t) = g AT (x4 = t);

{ A solid from its sections: sections[k], a plane figure of x1 and x2, at x3 = z[k]; z rises. It is as high as they are apart.
  Example: tr_reconstruct([pob_circle([0, 0], 1), pob_circle([0, 0], 0.5), pob_circle([0, 0], 0.8)], [-1, 0, 1]) AT (0.5, 0, 0)   // 0
  Source: [P95] 4.4 }
tr_reconstruct((array) sections, (array) z) =
  sections[1] + SUM(k = 1 TO LEN(z) - 1, (sections[k + 1] - sections[k])*CLAMP((x3 - z[k])/(z[k + 1] - z[k]), 0, 1))
  & (x3 - z[1] & z[LEN(z)] - x3);
