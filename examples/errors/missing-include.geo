{ There is no such file. }
INCLUDE "gears.geo";
