within HydraulicTestBench.Controllers;
block Gain "Output is a multiple of the input"
  extends Icons.Component;
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time";
  parameter Real k(final unit="1") = 1 "Output over input";
  Interfaces.RealInput u(unit="1") "Input"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealOutput y(unit="1") "Output"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
protected
  discrete Real held(unit="1", start=0, fixed=true) "Output";
equation
  when sample(0, dt) then
    held = k*u;
  end when;
  y = held;
  annotation(Documentation(info="<html>
<p>The master gains, the negation of the valve's command and both feed forwards are gains.</p>
<p><b>Source:</b> thesis Eq. 5.35 and 5.37, Tables 12 and 13.</p>
<p><b>Leaves out:</b> limits; <code>Limiter</code> has them.</p>
</html>"));
end Gain;
