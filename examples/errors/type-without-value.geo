{ A group of what? }
x8 : G;
