{ A file that includes itself. }
INCLUDE "include-circle.geo";
