within HydraulicTestBench.Interfaces;
partial model PartialCommandRate "Slot for the rate of the command"
  extends Icons.Slot;
  RealInput s(unit="%", nominal=10) "Command"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  RealInput s_t(unit="%/s", nominal=100) "Its time derivative as far as it is known, 0 where it is not"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  RealOutput rate(unit="%/s", nominal=100) "Time derivative of the command, for the PD controller"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  annotation(Documentation(info="<html>
<p>The PD controller differentiates the angle error (Eq. 3.17), and with it the command. How the rate is had is the law:
one equation for <code>rate</code>.</p>
<p><b>Source:</b> this library, for thesis Eq. 3.17.</p>
</html>"));
end PartialCommandRate;
