within HydraulicTestBench.Examples;
model TrueDelay "Response of the pump with a true delay in place of the Pade approximation"
  extends Icons.Example;
  Sources.GrowingSines command "Command"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Pump.FreeGreyBox pump(redeclare Pump.TransportDelay deadTime) "Pump with a true dead time"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
equation
  connect(command.y, pump.alphaCMD);
  connect(command.y_t, pump.alphaCMD_t);
  annotation(
    experiment(StartTime=0, StopTime=5, Interval=0.002, Tolerance=1e-8),
    Documentation(info="<html>
<p>As <code>TimeResponse</code>, with the slot <code>deadTime</code> redeclared; also the shortest example of how a
slot is
filled.</p>
<p><b>Source:</b> thesis Eq. 3.20.</p>
</html>"));
end TrueDelay;
