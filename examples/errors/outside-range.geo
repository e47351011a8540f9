{ 9 is not between 1 and 8. }
r1 = 9. IN [1., 8.] STEP 0.5;
