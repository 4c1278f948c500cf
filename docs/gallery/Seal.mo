model Seal "The real slide: its seal gives way like a bristle before it slips"
  input Real F(unit="N", start=0);
  output Real x(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
  Real z(unit="m", start=0, fixed=true) "Deflection of the bristle, 10 mm at most";
equation
  der(x) = v;
  2.1*der(v) = F - 6*v - 310*x - 8*z/10e-3;
  der(z) = v - abs(v)*z/10e-3;
end Seal;
