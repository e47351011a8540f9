{ Whether two objects meet is known or not; there is no number that may be off. }
u = UNCERTAINTY(INTERSECTS(1 - x1**2, x1));
