within HydraulicTestBench.Effects;
model SensorLag "Lag of the angle sensor (sensor.lag)"
  extends Interfaces.PartialSignalWithRate(y(start=0, fixed=true));
  parameter Types.Duration T_f(min=0, max=20e-3, nominal=2e-3) = 0 "Time constant, 0 = off";
  constant Types.Duration T_min = 1e-6 "Shortest time constant";
equation
  y_t = (s - y)/max(T_f, T_min);
  der(y) = y_t;
  annotation(__HydraulicTestBench(effect="sensor.lag", slot="angleSensor", bypass=true), Documentation(info="<html>
<p>T<sub>f</sub> dy/dt + y = s; the angle that is fed back and logged is y. A lag of 0 s has no equation: at
T<sub>f</sub> = 0 a lag of T<sub>min</sub> is left, 0.01 degrees at 30 Hz, and <b>off</b> means the neutral
filling.</p>
<p><b>Source:</b> this library; between thesis Eq. 3.10 and 3.18.</p>
<p><b>Valid:</b> T<sub>f</sub> from T<sub>min</sub> up.</p>
<p><b>Leaves out:</b> sampling and resolution of the sensor.</p>
</html>"));
end SensorLag;
