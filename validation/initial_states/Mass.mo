model Mass "A mass on a spring and a damper, pushed by a force"
  parameter Real m(unit="kg", min=0.1, max=100) = 2 "Mass";
  parameter Real d(unit="N.s/m", min=0.01, max=1000) = 8 "Damping";
  parameter Real c(unit="N/m", min=1, max=1e5) = 800 "Stiffness of the spring";
  input Real F(unit="N", start=0) "Force on the mass";
  output Real x(unit="m", start=0, fixed=true, nominal=0.1, min=-10, max=10) "Position";
  output Real v(unit="m/s", start=0, fixed=true, nominal=1, min=-100, max=100) "Speed";
equation
  der(x) = v;
  m*der(v) = F - d*v - c*x;
end Mass;
