{ The system of R-functions is one number. }
r_alpha(p) = p;
