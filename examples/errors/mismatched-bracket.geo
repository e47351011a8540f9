{ A `]` where a `)` belongs. }
a = 2 * (1 + 3];
