model Bench "The real slide: its rail is worn in the middle"
  input Real F(unit="N", start=0);
  output Real x(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
equation
  der(x) = v;
  2.1*der(v) = F - (15 - 12*exp(-(x/0.05)^2))*v - 310*x;
end Bench;
