{ A text has no sum. }
a = "a" + 1;
