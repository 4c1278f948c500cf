within HydraulicTestBench.Examples;
model UntoldRate "The same without telling the pump the rate of its command"
  extends Icons.Example;
  Sources.GrowingSines command "Command"
    annotation(Placement(transformation(extent={{-80, 20}, {-40, 60}})));
  Pump.FreeGreyBox pump "Pump"
    annotation(Placement(transformation(extent={{-20, 20}, {20, 60}})));
equation
  connect(command.y, pump.alphaCMD);
  pump.alphaCMD_t = 0;
  annotation(
    experiment(StartTime=0, StopTime=5, Interval=0.002, Tolerance=1e-8),
    Documentation(info="<html>
<p>As <code>TimeResponse</code>, but <code>alphaCMD_t</code> stays 0: <code>Pump.CommandRateObserver</code> estimates
the
rate. The angle differs by less than 0.001 percent.</p>
<p><b>Source:</b> thesis Eq. 3.17.</p>
</html>"));
end UntoldRate;
