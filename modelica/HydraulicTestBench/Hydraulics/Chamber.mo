within HydraulicTestBench.Hydraulics;
model Chamber "Oil volume with a pressure, thesis Eq. 3.4"
  extends Icons.Component;
  parameter Types.BulkModulus beta "Oil stiffness";
  parameter Types.Volume V_min(min=1e-9) = 1e-7 "Floor of the volume in the denominator";
  parameter Types.Pressure p_start = 0 "Pressure at the start";
  Interfaces.Port_a port "Node of all that flows in and out, displacement by a piston included"
    annotation(Placement(transformation(extent={{-10, -110}, {10, -90}})));
  Interfaces.RealInput V(unit="m3") "Volume of oil"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  Interfaces.RealInput kappa(unit="1/Pa") "Compressibility added to that of the oil"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  Types.Pressure p(start=p_start, fixed=true, stateSelect=StateSelect.always) "Pressure";
  Real p_t(final unit="Pa/s", nominal=1e8) "Rate of pressure";
  Types.BulkModulus beta_eff "Effective stiffness";
equation
  port.p = p;
  der(p) = p_t;
  beta_eff = beta/(1 + beta*kappa);
  p_t = beta_eff/Functions.flooredVolume(V, V_min)*port.q;
  annotation(Documentation(info="<html>
<p>dp/dt = &beta;<sub>eff</sub>/V &Sigma;Q, with 1/&beta;<sub>eff</sub> = 1/&beta; + &kappa;. The flow a moving piston
displaces comes through the port like any other.</p>
<p><b>Source:</b> thesis Eq. 3.4 and 3.5.</p>
<p><b>Valid:</b> gauge pressures from about -1 to 400 bar; volumes well above V_min are used as they are, below it the
floor of <code>Functions.flooredVolume</code> holds.</p>
<p><b>Leaves out:</b> cavitation (the pressure may fall below vacuum), temperature, waves.</p>
</html>"));
end Chamber;
