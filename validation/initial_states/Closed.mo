model Closed "The same mass as its maker hands it out: parameters, force and position"
  parameter Real m(unit="kg", min=0.1, max=100) = 2 "Mass";
  parameter Real d(unit="N.s/m", min=0.01, max=1000) = 8 "Damping";
  parameter Real c(unit="N/m", min=1, max=1e5) = 800 "Stiffness of the spring";
  input Real F(unit="N", start=0) "Force on the mass";
  output Real x(unit="m") "Position";
protected
  Real s1(start=0, fixed=true);
  Real s2(start=0, fixed=true);
equation
  x = 0.25*s1;
  der(s1) = 4*s2;
  m*der(s2) = F - d*s2 - c*x;
end Closed;
