{ The setting is written x1min. }
x1_min = -3;
