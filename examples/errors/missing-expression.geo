{ Nothing stands behind the `+`. }
a = 3 + ;
