{ A text is no element. }
a = ["one", 2];
