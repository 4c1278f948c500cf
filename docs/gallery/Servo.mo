model Servo "A cylinder behind a valve, with the oil as a spring"
  parameter Real K(unit="m/(s.V)") = 0.05 "Speed of the cylinder at 1 V";
  parameter Real T(unit="s") = 0.03 "Lag of the valve";
  parameter Real w(unit="rad/s") = 70 "Resonance of load and oil";
  input Real u(unit="V", start=0) "Voltage of the valve";
  output Real x(unit="m", start=0, fixed=true) "Position of the cylinder";
  Real s(unit="V", start=0, fixed=true) "Opening of the valve, in volts of its command";
  Real v(unit="m/s", start=0, fixed=true) "Velocity";
  Real a(unit="m/s2", start=0, fixed=true) "Acceleration";
equation
  T*der(s) = u - s;
  der(x) = v;
  der(v) = a;
  der(a) = w^2*(K*s - v) - 2*0.3*w*a;
end Servo;
