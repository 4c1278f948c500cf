within HydraulicTestBench.Controllers;
block NormalizeSignal "Swash plate angle in percent of the largest"
  extends Icons.Component;
  parameter Types.Duration dt(min=1e-6) = 1e-3 "Sampling time";
  parameter Types.Angle largest(min=1e-3) = 15*Constants.pi/180 "Largest angle";
  Interfaces.RealInput angle(unit="rad") "Angle"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealOutput percent(unit="%") "Share of the largest, within 100 percent"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
protected
  discrete Real held(unit="%", start=0, fixed=true) "Output";
equation
  when sample(0, dt) then
    held = min(max(100*angle/largest, -100), 100);
  end when;
  percent = held;
  annotation(Documentation(info="<html>
<p>What the pump's controller card takes as its command.</p>
<p><b>Source:</b> <code>NormalizeSignal</code> of thesis Table 12.</p>
<p><b>Valid:</b> either direction.</p>
</html>"));
end NormalizeSignal;
