within HydraulicTestBench.Interfaces;
partial model PartialDeadTime "Slot for the dead time of the inner loop"
  extends Icons.Slot;
  parameter Types.Duration tau "Dead time";
  RealInput s(unit="1") "Spool command of the card"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  RealOutput y(unit="1") "The same, tau later"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  annotation(Documentation(info="<html>
<p>The law is one equation that gives y from s and tau.</p>
<p><b>Source:</b> thesis Eq. 3.20, the factor e<sup>-&tau;s</sup>.</p>
</html>"));
end PartialDeadTime;
