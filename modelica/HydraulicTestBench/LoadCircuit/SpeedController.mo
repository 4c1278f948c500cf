within HydraulicTestBench.LoadCircuit;
block SpeedController "Speed by the pump's angle: PI and feed forward, thesis Eq. 5.32 and 5.35"
  extends Icons.Component;
  constant Data.LoadCircuit bench = Data.LoadCircuit() "Parameters of the bench";
  parameter Real K_P(final unit="s", min=0, nominal=1e-7) = bench.K_Ps "Gain, rad per rad/s";
  parameter Types.Duration T_i(min=1e-6) = bench.T_is "Integration time";
  parameter Real masterSpeed(final unit="1", min=0) = 1 "Master gain of the PI controller";
  parameter Types.AngularVelocity omega_zero = 2 "Below this measured speed the PI controller is off";
  parameter Types.Duration T_t(min=1e-3) = 0.1 "Time in which the integral follows a limit";
  parameter Types.Angle alphaMAX = 15*Constants.pi/180 "Largest swash plate angle";
  parameter Real feed(final unit="s", nominal=1e-3) = bench.Vm_max/(71e-6*1450/60)*alphaMAX/(2*Constants.pi)
    "K_s/K_P of Eq. 5.35: angle over speed";
  Interfaces.RealInput omegaS(unit="rad/s") "Measured speed"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput omegaS_ref(unit="rad/s") "Reference"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Interfaces.RealOutput NormalizeSignal(unit="%") "Command of the pump's angle"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Types.AngularVelocity abs_omegaS "Absolute value of the measured speed";
  Real ZeroSwitch(unit="1") "1 where the PI controller is on, else 0";
  Types.Angle I(start=0, fixed=true) "Integral part";
  Types.Angle PI "Output of the PI controller";
  Types.Angle alpha_feed "Feed forward, Eq. 5.35";
  Types.Angle alpha "Desired swash plate angle";
protected
  Types.AngularVelocity e "Error";
  Types.Angle wanted "Desired angle before its limit";
equation
  abs_omegaS = abs(omegaS);
  ZeroSwitch = if abs_omegaS > omega_zero then 1 else 0;
  e = omegaS_ref - omegaS;
  der(I) = ZeroSwitch*(masterSpeed*K_P/T_i*e + (alpha - wanted)/T_t);
  PI = ZeroSwitch*(masterSpeed*K_P*e + I);
  alpha_feed = feed*omegaS_ref;
  wanted = PI + alpha_feed;
  alpha = min(max(wanted, -alphaMAX), alphaMAX);
  NormalizeSignal = 100*alpha/alphaMAX;
  annotation(Documentation(info="<html>
<p>&alpha; = K<sub>P</sub>(e + &int;e/T<sub>i</sub>) + K<sub>s</sub>/K<sub>P</sub> &omega;<sub>ref</sub>, with the PI
part off near standstill, where the pulses say nothing.</p>
<p><b>Source:</b> thesis Eq. 5.32, 5.34, 5.35, Table 6.1 (manually tuned), names of Table 12. The thesis' controller is
the difference equation 5.33; this is its continuous form. Its threshold is not published.</p>
<p><b>Valid:</b> sampling much faster than the loop.</p>
<p><b>Leaves out:</b> sampling.</p>
</html>"));
end SpeedController;
