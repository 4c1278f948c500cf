model FlowTest "The pump block without load at a constant speed of its drive, as in thesis Section 4.1"
  parameter HydraulicTestBench.Types.AngularVelocity omega(min=140, max=165) = 151.8436 "Speed of the drive";
  input Real alphaCMD(unit="%", min=-100, max=100, start=0, nominal=10) "Swash plate angle command";
  input Real alphaCMD_t(unit="%/s", start=0, nominal=100) "Rate of alphaCMD where known, else 0";
  output Real Q(unit="m3/s", nominal=1e-3) "Flow out of port A";
  output Real f_stop(unit="N", nominal=1e3) "Force of the end stops on the control piston";
  HydraulicTestBench.Pump.A4VSG pump(redeclare HydraulicTestBench.Pump.MeanFlow pumpFlow) "Pump";
  HydraulicTestBench.Mechanics.ConstantSpeed drive(w=omega) "Drive";
  HydraulicTestBench.Hydraulics.Tank load "No load at port A";
  HydraulicTestBench.Hydraulics.Tank inlet "Port B";
  HydraulicTestBench.Hydraulics.Tank tank "Drain";
equation
  connect(drive.flange, pump.shaft);
  connect(pump.port_A, load.port);
  connect(pump.port_B, inlet.port);
  connect(pump.port_D, tank.port);
  pump.alphaCMD = alphaCMD;
  pump.alphaCMD_t = alphaCMD_t;
  Q = pump.QActual;
  f_stop = pump.piston.f_stop;
end FlowTest;
