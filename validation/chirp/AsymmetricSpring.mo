model AsymmetricSpring "A mass on a spring that is stiffer on one side of its rest position"
  input Real u(start = 50) "Command";
  output Real y "Position";
  parameter Real x_0 = 50 "Rest position, where the stiffness changes";
  parameter Real omega(min = 0) = 50.26548245743669 "Natural frequency of the even spring, rad/s (8 Hz)";
  parameter Real zeta(min = 0) = 0.5 "Damping ratio";
  parameter Real e(min = 0) = 0.1 "Stiffness is 1 + e above the rest position and 1 - e below it";
  parameter Real w = 0.01 "Width of the change";
  Real x(start = 50, fixed = true);
  Real v(start = 0, fixed = true);
equation
  der(x) = v;
  der(v) = omega^2*(u - x_0 - (x - x_0) - e*(sqrt((x - x_0)^2 + w^2) - w)) - 2*zeta*omega*v;
  y = x;
end AsymmetricSpring;
