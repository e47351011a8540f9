{ IF is no name. }
IF = 3;
