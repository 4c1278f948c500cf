within HydraulicTestBench.Controllers;
block Limiter "Keeps a signal within two limits"
  extends Icons.Component;
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time";
  parameter Real low(final unit="1") = -1 "Least output";
  parameter Real high(final unit="1") = 1 "Largest output";
  Interfaces.RealInput u(unit="1") "Input"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealOutput y(unit="1") "Output"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
protected
  discrete Real held(unit="1", start=0, fixed=true) "Output";
equation
  when sample(0, dt) then
    held = min(max(u, low), high);
  end when;
  y = held;
  annotation(Documentation(info="<html>
<p>y = min(max(u, low), high).</p>
<p><b>Source:</b> <code>limit1</code> of thesis Table 13.</p>
<p><b>Valid:</b> low below high.</p>
</html>"));
end Limiter;
