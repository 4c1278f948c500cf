within HydraulicTestBench.LoadCircuit;
block LoadController "Load pressure by the servo valve: PI and feed forward, thesis Eq. 5.32 and 5.37"
  extends Icons.Component;
  constant Data.LoadCircuit bench = Data.LoadCircuit() "Parameters of the bench";
  parameter Real K_P(final unit="1/Pa", min=0, nominal=1e-9) = bench.K_PL "Gain";
  parameter Types.Duration T_i(min=1e-6) = bench.T_iL "Integration time";
  parameter Real masterLoad(final unit="1", min=0) = 1 "Master gain of the PI controller";
  parameter Types.Duration T_t(min=1e-3) = 0.1 "Time in which the integral follows a limit";
  parameter Real feed(final unit="s/rad", nominal=1e-3) = bench.Vm_max/(2*Constants.pi)/bench.K_qu
    "K_L/K_qu of Eq. 5.37: opening over speed";
  Interfaces.RealInput pL(unit="Pa") "Pressure across the load motor"
    annotation(Placement(transformation(extent={{-140, 60}, {-100, 100}})));
  Interfaces.RealInput pL_ref(unit="Pa") "Reference"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealInput omegaS_ref(unit="rad/s") "Reference of the speed"
    annotation(Placement(transformation(extent={{-140, -100}, {-100, -60}})));
  Interfaces.RealOutput limit1(unit="1") "Command of the servo valve, within -1 ... 1"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  Real I(unit="1", nominal=1, start=0, fixed=true) "Integral part";
  Real pI2(unit="1") "Output of the PI controller";
  Real u_feed(unit="1") "Feed forward, Eq. 5.37";
  Real Negate(unit="1") "Negated command, for a valve whose ports A and B are exchanged";
protected
  Types.Pressure e "Error";
  Real wanted(unit="1") "Command before its limit";
equation
  e = pL_ref - pL;
  der(I) = masterLoad*K_P/T_i*e + (limit1 - wanted)/T_t;
  pI2 = masterLoad*K_P*e + I;
  u_feed = -feed*omegaS_ref;
  wanted = pI2 + u_feed;
  limit1 = min(max(wanted, -1), 1);
  Negate = -limit1;
  annotation(Documentation(info="<html>
<p>u = K<sub>P</sub>(e + &int;e/T<sub>i</sub>) - K<sub>L</sub>/K<sub>qu</sub> &omega;<sub>ref</sub>. A positive command
raises p<sub>L</sub>; in the thesis' simulation the valve was drawn the other way round and got <code>Negate</code>.</p>
<p><b>Source:</b> thesis Eq. 5.32, 5.36, 5.37, Table 6.1 (manually tuned), names of Table 13. The thesis' controller is
the difference equation 5.33; this is its continuous form.</p>
<p><b>Valid:</b> sampling much faster than the loop.</p>
<p><b>Leaves out:</b> sampling.</p>
</html>"));
end LoadController;
